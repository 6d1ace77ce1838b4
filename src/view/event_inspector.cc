#include "view/event_inspector.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "extract/extraction.h"
#include "measurement/event_outlines.h"
#include "report/event_columns.h"
#include "report/rows_json.h"
#include "serve/grey_png.h"
#include "shape/outline_shape.h"
#include "view/combined_cells.h"
#include "view/event_json.h"
#include "view/model_outline.h"
#include "view/page_words.h"
#include "view/recording_columns.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

Json points_json(const Eigen::MatrixX2d& points) {
  Json x = Json::array(), y = Json::array();
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    x.push_back(points(i, 0));
    y.push_back(points(i, 1));
  }
  return {{"x_um", x}, {"y_um", y}};
}

void check_event(const Recording& recording, std::size_t event) {
  if (event >= recording.events())
    refuse_path(recording.file(),
                fmt::format("has no event {}; its {} events are counted from 0.", event, recording.events()));
}

/// Distance of the outline from its centroid, divided by its mean, less the same of the model's: what is left of the
/// shape once size and place agree.
class ShapeResidual {
 public:
  ShapeResidual(const Eigen::MatrixX2d& model, double mean_radius) : mean_radius_(mean_radius) {
    for (Eigen::Index i = 0; i < model.rows(); ++i)
      nodes_.push_back({std::atan2(model(i, 1), model(i, 0)), model.row(i).norm()});
    std::ranges::sort(nodes_, {}, &Node::angle);
  }

  double at(double x, double y, double measured_mean_radius) const {
    const double angle = std::atan2(y, x), radius = std::hypot(x, y);
    return radius * mean_radius_ / measured_mean_radius - radius_at(angle);
  }

 private:
  struct Node {
    double angle, radius;
  };
  double radius_at(double angle) const {
    const auto above = std::ranges::lower_bound(nodes_, angle, {}, &Node::angle);
    const Node &b = above == nodes_.end() ? nodes_.front() : *above,
               &a = above == nodes_.begin() ? nodes_.back() : *std::prev(above);
    const double whole = std::remainder(b.angle - a.angle, 2 * M_PI), part = std::remainder(angle - a.angle, 2 * M_PI);
    return whole == 0 ? a.radius : a.radius + (b.radius - a.radius) * part / whole;
  }

  double mean_radius_;
  std::vector<Node> nodes_;
};

/// A model's outline with its front where the recording's cells move to.
Eigen::MatrixX2d with_front(Eigen::MatrixX2d model, int direction) {
  if (direction < 0) model.col(0) *= -1;
  return model;
}

/// About the centroid of a measured outline.
Eigen::MatrixX2d laid_over(Eigen::MatrixX2d model, const OutlineShape& measured) {
  model.rowwise() += Eigen::RowVector2d(measured.x, measured.y);
  return model;
}

Json model_json(const ModelOutline& cell, const Eigen::MatrixX2d& outline, int direction, const std::string& table) {
  const OutlineShape measured = outline_shape(outline);
  const Eigen::MatrixX2d model = with_front(cell.outline, direction);
  const ShapeResidual residual(model, outline_shape(model).mean_radius);
  Json residuals = Json::array();
  double squares = 0;
  for (Eigen::Index i = 0; i < outline.rows(); ++i) {
    const double r = residual.at(outline(i, 0) - measured.x, outline(i, 1) - measured.y, measured.mean_radius);
    residuals.push_back(r);
    squares += r * r;
  }
  Json j = points_json(laid_over(model, measured));
  j["area_um2"] = cell.area_um2;
  j["deformation"] = cell.deformation;
  j["residual_um"] = residuals;
  j["residual_rms_um"] = std::sqrt(squares / static_cast<double>(outline.rows()));
  j["direction"] = direction < 0 ? -1 : 1;
  j["source"] = fmt::format("shapes of the table {}: modes c2 to c7 of the outline", table);
  return j;
}

/// The live solver's case of this cell; section and liquid are those of the table, with the viscosity that it had for
/// the event.
Json case_json(const ModelOutline& cell, const TableOrigin& origin, ChannelFlow flow, double young_modulus_kPa) {
  flow.exponent = origin.flow.exponent;
  Json bulk{{"young_modulus_kPa", young_modulus_kPa}};
  if (const auto end = origin.model.find(" solid"); end != std::string::npos) bulk["law"] = origin.model.substr(0, end);
  Json channel{{"width_um", flow.width_um}};
  if (origin.section == Section::square) channel["section"] = "square";
  return {{"channel", channel}, {"flow", flow_json(flow)}, {"cell", {{"radius_um", cell.radius_um}, {"bulk", bulk}}}};
}

void add_fit(const Extraction& extraction, const EventBlock& block, const ModulusTables& tables,
             const Eigen::MatrixX2d& outline, Json& j) {
  const MeasuringConditions& conditions = extraction.settings().conditions;
  const ShapeMap* const map = tables.shapes(conditions.flow.exponent);
  if (!has_modulus(block.state[0])) return;
  const auto cell = map ? model_outline(*map, conditions, block.area_um2[0], block.deformation[0]) : std::nullopt;
  if (!cell) {
    j["sentence"] = "No available table contains the shape of the cell of the model.";
    return;
  }
  ChannelFlow flow = conditions.flow;
  flow.viscosity_mPas = block.viscosity_mPas[0];
  j["case"] = case_json(*cell, extraction.table().origin(), flow, block.young_modulus_kPa[0]);
  if (outline.rows() > 2)
    j["model"] = model_json(*cell, outline, extraction.event_shapes().direction(), map->origin().identifier);
}

/// What a combined table says of the event, with the outline of its cell over the measured one.
Json combined_json(CombinedCell cell, const Eigen::MatrixX2d& outline, int direction) {
  cell.told["contour"] =
      cell.outline.rows() > 0 && outline.rows() > 2
          ? points_json(laid_over(with_front(std::move(cell.outline), direction), outline_shape(outline)))
          : Json();
  return std::move(cell.told);
}

double first_of(std::span<const double> values) { return values.empty() ? NAN : values[0]; }

/// Of all columns, null where nothing is known.
void add_columns(const Extraction& extraction, const EventBlock& block, Json& j) {
  for (const auto& column : event_columns({true, true, true, ElongatedBy::modes}))
    j[column.name] = column.is_flag ? Json(false) : Json();
  BlockValues<EventBlock> values(event_columns(extraction.knowledge()));
  const auto numbers = values.of(block);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    j[values.columns()[k].name] = value_json(values.columns()[k], cell_value(values.columns()[k], numbers[k][0]));
}

/// What is to be said of the modulus.
std::string sentence_on(const EventBlock& block) {
  std::string on_state(sentence_of(block.state[0]));
  const ElongationBlock& drawn = block.elongation;
  const double modulus = first_of(drawn.modulus_kPa), tension = first_of(drawn.axial_tension_Pa);
  if (block.shape.empty() || !block.shape[0].is_elongated() || !std::isfinite(modulus)) return on_state;
  return fmt::format(
      "{}{}The cell is longer along the flow than those of the table, so that its modulus from deformation is too low; "
      "a solid elongated by a tension of {:.0f} Pa has this shape with {:.3g} kPa.",
      on_state, on_state.empty() ? "" : " ", tension, modulus);
}

}  // namespace

EventInspector::EventInspector(const InspectedRecording& file, const ExtractOptions& options,
                               const ModulusTables& tables)
    : recording_(file.recording),
      tables_(tables),
      columns_(file.recording, file.computed),
      pixel_um_(
          options.measuring.pixel_size_um.value_or(recording_.metadata().number("imaging:pixel size").value_or(0))) {
  if (ShapeSource::has_outlines(recording_) && pixel_um_ > 0) outlines_.emplace(recording_, pixel_um_);
  try {
    extraction_ = std::make_unique<Extraction>(recording_, options, tables);
  } catch (const UserError& missing) {
    missing_ = in_words_of_page(missing.what());
  }
  if (!file.combined || !outlines_) return;
  try {
    combined_ = std::make_unique<CombinedCells>(recording_, options.measuring, *file.combined);
  } catch (const UserError&) {  // what is missing for several moduli is missing for one, and reported there
  }
}

EventInspector::~EventInspector() = default;

Json EventInspector::features(std::size_t event) {
  Json features = Json::object();
  for (const auto& name : columns_.names()) {
    std::array<double, 1> value{};
    columns_.read(name, event, value);
    features[name] = number_or_null(value[0]);
  }
  return features;
}

/// The outline through the middles of the outermost pixels, in the frame of the picture; without rows if there is none.
Eigen::MatrixX2d EventInspector::outline(std::size_t event) {
  if (!outlines_) return {};
  const PixelContour contour = outlines_->outline(event);
  Eigen::MatrixX2d points(static_cast<Eigen::Index>(contour.size()), 2);
  Eigen::Index row = 0;
  for (const PixelPoint& pixel : contour) points.row(row++) << (pixel.x + 0.5) * pixel_um_, (pixel.y + 0.5) * pixel_um_;
  return points;
}

Json EventInspector::inspect(std::size_t event) {
  check_event(recording_, event);
  Json j{{"event", event}, {"features", features(event)}, {"pixel_um", number_or_null(pixel_um_)}};
  for (const char* feature : {"image", "mask"})
    if (const auto size = recording_.image_size(feature))
      j["image_size"] = {{"width", size->width}, {"height", size->height}};
  for (const char* key :
       {"young_modulus_kPa", "young_modulus_kPa_error", "shape_excess", "outline", "model", "combined", "case"})
    j[key] = nullptr;
  const Eigen::MatrixX2d points = outline(event);
  if (points.rows() > 0) j["outline"] = points_json(points);
  try {
    if (!extraction_) throw UserError(missing_);
    const EventBlock block = extraction_->compute(event, 1);
    add_columns(*extraction_, block, j);
    j["sentence"] = sentence_on(block);
    add_fit(*extraction_, block, tables_, points, j);
    if (combined_) j["combined"] = combined_json(combined_->at(event), points, extraction_->event_shapes().direction());
  } catch (const UserError& missing) {
    j["state"] = "unknown";
    j["sentence"] = missing.what();
  }
  return j;
}

std::string picture_of_event(const Recording& recording, const std::string& feature, std::size_t event) {
  check_event(recording, event);
  const auto size = recording.image_size(feature);
  if (!size) refuse_path(recording.file(), fmt::format("holds no pictures of the kind {}.", one_line(feature, 60)));
  std::vector<std::uint8_t> pixels(size->pixels());
  recording.read_images(feature, event, 1, pixels);
  if (feature == "mask")
    for (auto& pixel : pixels) pixel = pixel ? 255 : 0;
  return grey_png({size->width, size->height}, pixels);
}

}  // namespace rheocyte
