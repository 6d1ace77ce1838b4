#include "synth/virtual_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "case/user_error.h"
#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "measurement/mask_from_outline.h"
#include "measurement/metadata.h"
#include "measurement/outline_noise.h"
#include "measurement/recording_file.h"
#include "measurement/viscosity.h"
#include "numeric/cell_random.h"
#include "synth/outline.h"
#include "synth/pixel_picture.h"

namespace rheocyte {

namespace {

constexpr std::size_t cells_per_block = 1024;   // events that are written together
constexpr double spread_along_channel_px = 10;  // of the places at which cells are taken

// Names of the features of an event in the file, and where they come from.
struct FeatureOfOutline {
  const char* name;
  double (*value)(const ContourFeatures&, double pixel_size_um);
};

constexpr std::array features_of_outlines{
    FeatureOfOutline{"area_um", [](const ContourFeatures& f, double) { return f.area_um2; }},
    FeatureOfOutline{"deform", [](const ContourFeatures& f, double) { return f.deformation; }},
    FeatureOfOutline{"circ", [](const ContourFeatures& f, double) { return 1 - f.deformation; }},
    FeatureOfOutline{"area_cvx", [](const ContourFeatures& f, double px) { return f.area_um2 / (px * px); }},
    FeatureOfOutline{"area_msd", [](const ContourFeatures& f, double) { return f.raw_area_px; }},
    FeatureOfOutline{"area_ratio", [](const ContourFeatures& f, double) { return f.area_ratio; }},
    FeatureOfOutline{"pos_x", [](const ContourFeatures& f, double) { return f.x_um; }},
    FeatureOfOutline{"pos_y", [](const ContourFeatures& f, double) { return f.y_um; }},
    FeatureOfOutline{"size_x", [](const ContourFeatures& f, double) { return f.width_um; }},
    FeatureOfOutline{"size_y", [](const ContourFeatures& f, double) { return f.height_um; }},
    FeatureOfOutline{"aspect", [](const ContourFeatures& f, double) { return f.width_um / f.height_um; }},
    FeatureOfOutline{"inert_ratio_cvx", [](const ContourFeatures& f, double) { return f.inertia_ratio; }},
    FeatureOfOutline{"inert_ratio_raw", [](const ContourFeatures& f, double) { return f.inertia_ratio_raw; }},
    FeatureOfOutline{"inert_ratio_prnc", [](const ContourFeatures& f, double) { return f.inertia_ratio_principal; }},
    FeatureOfOutline{"tilt", [](const ContourFeatures& f, double) { return f.tilt; }},
    FeatureOfOutline{"volume", [](const ContourFeatures& f, double) { return f.volume_um3; }},
};

/// All that is written of a block of events.
struct Block {
  std::map<std::string, std::vector<double>> columns;
  std::vector<std::uint8_t> masks, images;
  std::size_t events = 0;
};

/// Of the tension or the shape at rest, one of which a table has; dclab knows userdef0 to userdef9.
const std::string elongation_feature = "userdef0", elongation_key = "user:rheocyte " + elongation_feature;
constexpr const char *meaning_of_tension = "true axial tension (Pa)",
                     *meaning_of_aspect = "true length over width at rest";

/// Cells one after the other, each from its own random numbers.
class VirtualCamera {
 public:
  VirtualCamera(const SynthSpec& spec, const CellShapes& shapes, VirtualRecording& result)
      : spec_(spec), shapes_(shapes), size_(spec.image_size()), result_(result), mask_(size_.pixels()) {
    if (!spec.viscosity_mPas) buffer_.emplace(*medium_of_name(spec.medium), spec.viscosity_model);
  }

  /// Adds the cell of this number to the block, if it can be seen; a cell on its way at each of its places.
  void take(std::uint64_t number, Block& block) {
    ++result_.cells;
    auto [cell, celsius] = drawn(number);
    if (!spec_.is_on_its_way()) return see(cell, {number, number, celsius}, block);
    const std::size_t places = spec_.places_um.size();
    arrive(number);
    for (std::size_t k = 0; k < places; ++k) {
      cell.place_um = spec_.places_um[k];
      see(cell, {number, number * places + k, celsius}, block);
    }
  }

 private:
  /// Of a picture: numbers of its cell and of itself.
  struct Picture {
    std::uint64_t cell, number;
    double celsius;
  };

  std::pair<VirtualCell, double> drawn(std::uint64_t number) const {
    auto random = CellRandom(seed(), number, Purpose::population);
    VirtualCell cell;
    cell.radius_um = spec_.radius_um.at(random.normal());
    cell.stiffness = spec_.stiffness().at(random.normal());
    if (is_combined()) {
      cell.cortex_modulus_mN_per_m = spec_.cortex_modulus_mN_per_m->at(random.normal());
      const double normal = random.normal();
      cell.tension_mN_per_m = spec_.tension_mN_per_m
                                  ? spec_.tension_mN_per_m->at(normal)
                                  : spec_.tension_ratio.value_or(Spread{}).at(normal) * cell.cortex_modulus_mN_per_m;
    }
    const double celsius = spec_.temperature_C.at(CellRandom(seed(), number, Purpose::temperature).normal());
    cell.viscosity_mPas = buffer_ ? buffer_->viscosity({spec_.channel_width_um, spec_.flow_rate_ul_s}, celsius)
                                  : spec_.viscosity_mPas.value_or(0);
    if (spec_.viscosity_of_cell_mPas) cell.own_viscosity_mPas = spec_.viscosity_of_cell_mPas->at(random.normal());
    if (spec_.axial_tension_Pa) cell.axial_tension_Pa = spec_.axial_tension_Pa->at(random.normal());
    if (spec_.rest_aspect) cell.rest_aspect = spec_.rest_aspect->at(random.normal());
    return {cell, celsius};
  }

  void see(const VirtualCell& cell, const Picture& picture, Block& block) {
    ++result_.pictures;
    auto found = shapes_.shape(cell);
    if (const auto* const reason = std::get_if<NoShape>(&found)) return count(*reason);
    const auto& shape = std::get<CellShape>(found);
    const auto outline = outline_in_picture(shape, cell, picture.number);
    if (!fill_mask(outline, size_, mask_)) return count(NoShape::outside_picture);
    const auto features = measurer_.measure(finder_.contour_of({size_, mask_}), spec_.pixel_size_um);
    if (!std::isfinite(features.area_um2)) return count(NoShape::too_small);
    ++result_.events;
    ++block.events;
    add_features(features, block);
    add_truth(cell, shape, features, block);
    if (spec_.is_on_its_way()) block.columns["userdef9"].push_back(double(picture.cell + 1));
    add_time(shape, picture, block);
    add_pictures(outline, picture.number, block);
  }

  bool is_combined() const { return spec_.kind == CellKind::combined; }
  std::uint64_t seed() const { return static_cast<std::uint64_t>(spec_.seed); }
  void count(NoShape reason) { ++result_.missing[static_cast<std::size_t>(reason)]; }

  // In pixels; the cell lies anywhere between the pixels.
  Eigen::MatrixX2d outline_in_picture(const CellShape& shape, const VirtualCell& cell, std::uint64_t number) {
    auto place = CellRandom(seed(), number, Purpose::place), noise = CellRandom(seed(), number, Purpose::contour);
    Eigen::MatrixX2d outline = with_ellipse(silhouette(shape.meridian), spec_.added_ellipse);
    outline = displaced(outline, {spec_.contour_um, spec_.contour_correlation_um}, noise) / spec_.pixel_size_um;
    const double middle = 0.5 * (outline.col(0).maxCoeff() + outline.col(0).minCoeff());
    const double taken = spread_along_channel_px * (2 * place.uniform() - 1);
    const double x = spec_.is_on_its_way() ? cell.place_um / spec_.pixel_size_um
                                           : 0.5 * static_cast<double>(size_.width) - middle + taken;
    const double y = axis() + place.uniform() - 0.5 + spec_.lateral_um / spec_.pixel_size_um * place.normal();
    outline.rowwise() += Eigen::RowVector2d(x, y);
    return outline;
  }

  double axis() const { return 0.5 * static_cast<double>(size_.height - 1); }

  void add_features(const ContourFeatures& features, Block& block) const {
    for (const auto& feature : features_of_outlines)
      block.columns[feature.name].push_back(feature.value(features, spec_.pixel_size_um));
  }

  void add_truth(const VirtualCell& cell, const CellShape& shape, const ContourFeatures& features, Block& block) {
    std::vector truth{cell.radius_um,    cell.stiffness,   shape.area_um2,
                      shape.deformation, shape.volume_um3, cell.viscosity_mPas};
    if (is_combined()) truth.insert(truth.end(), {cell.cortex_modulus_mN_per_m, cell.tension_mN_per_m});
    if (spec_.is_on_its_way()) truth.insert(truth.end(), {cell.own_viscosity_mPas, cell.place_um});
    for (std::size_t k = 0; k < truth.size(); ++k) block.columns[fmt::format("userdef{}", k + 1)].push_back(truth[k]);
    if (spec_.axial_tension_Pa) block.columns[elongation_feature].push_back(cell.axial_tension_Pa);
    if (spec_.rest_aspect) block.columns[elongation_feature].push_back(cell.rest_aspect);
    result_.mean_area_error += features.area_um2 / shape.area_um2 - 1;
    result_.mean_deformation_error += features.deformation - shape.deformation;
  }

  void arrive(std::uint64_t number) {
    auto arrival = CellRandom(seed(), number, Purpose::arrival);
    frame_ += 1 + std::floor(-std::log(arrival.uniform()) * spec_.frame_rate_Hz / spec_.cells_per_s);
  }

  void add_time(const CellShape& shape, const Picture& picture, Block& block) {
    if (!spec_.is_on_its_way()) arrive(picture.cell);
    const double frame = frame_ + shape.time_s * spec_.frame_rate_Hz;  // on its way a cell is taken at its places
    block.columns["frame"].push_back(std::floor(frame));
    block.columns["time"].push_back(frame / spec_.frame_rate_Hz);
    block.columns["index"].push_back(static_cast<double>(result_.events));
    auto thermometer = CellRandom(seed(), picture.number, Purpose::thermometer);
    if (buffer_) block.columns["temp"].push_back(picture.celsius + spec_.thermometer_C * thermometer.normal());
  }

  void add_pictures(const Eigen::MatrixX2d& outline, std::uint64_t number, Block& block) const {
    if (spec_.pictures == Pictures::none) return;
    block.masks.insert(block.masks.end(), mask_.begin(), mask_.end());
    if (spec_.pictures != Pictures::images) return;
    auto random = CellRandom(seed(), number, Purpose::picture);
    block.images.resize(block.images.size() + size_.pixels());
    draw_grey(outline, {spec_.pixel_size_um, axis(), spec_.channel_width_um}, size_, random,
              std::span(block.images).last(size_.pixels()));
  }

  const SynthSpec& spec_;
  const CellShapes& shapes_;
  ImageSize size_;
  VirtualRecording& result_;
  std::optional<Buffer> buffer_;
  std::vector<std::uint8_t> mask_;
  ContourFinder finder_;
  ContourMeasurer measurer_;
  double frame_ = 0;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void write_metadata(const SynthSpec& spec, const RecordingProvenance& provenance, RecordingFile& file) {
  const ImageSize size = spec.image_size();
  file.add_metadata("experiment:date", spec.date);
  file.add_metadata("experiment:time", spec.time);
  file.add_metadata("experiment:run index", std::int64_t{1});
  file.add_metadata("experiment:sample", spec.sample);
  file.add_metadata("imaging:flash device", std::string("none (virtual)"));
  file.add_metadata("imaging:flash duration", 1.0);
  file.add_metadata("imaging:frame rate", spec.frame_rate_Hz);
  file.add_metadata("imaging:pixel size", spec.pixel_size_um);
  file.add_metadata("imaging:roi position x", std::int64_t{0});
  file.add_metadata("imaging:roi position y", std::int64_t{0});
  file.add_metadata("imaging:roi size x", static_cast<std::int64_t>(size.width));
  file.add_metadata("imaging:roi size y", static_cast<std::int64_t>(size.height));
  constexpr double sheath_fraction = 0.75;  // of the flow, as usual
  file.add_metadata("setup:channel width", spec.channel_width_um);
  file.add_metadata("setup:chip region", std::string("channel"));
  file.add_metadata("setup:flow rate", spec.flow_rate_ul_s);
  file.add_metadata("setup:flow rate sample", (1 - sheath_fraction) * spec.flow_rate_ul_s);
  file.add_metadata("setup:flow rate sheath", sheath_fraction * spec.flow_rate_ul_s);
  file.add_metadata("setup:identifier", std::string("virtual"));
  file.add_metadata("setup:medium", spec.medium.empty() ? std::string("other") : spec.medium);
  file.add_metadata("setup:module composition", std::string("virtual"));
  file.add_metadata("setup:software version", provenance.program);
  if (spec.viscosity_mPas)
    file.add_metadata(viscosity_key, *spec.viscosity_mPas);
  else
    file.add_metadata("setup:temperature", spec.temperature_C.mean);
}

void describe_truth(const SynthSpec& spec, const CellShapes& shapes, const VirtualRecording& result,
                    RecordingFile& file) {
  const char* const cortex = "cortex modulus E2D (mN/m)";
  std::vector<const char*> meanings{"radius of the sphere at rest (um)",
                                    spec.kind == CellKind::shell ? cortex : "Young's modulus (kPa)",
                                    "area of the convex hull (um^2)",
                                    "deformation of the convex hull",
                                    "volume (um^3)",
                                    "viscosity (mPa s)"};
  if (spec.is_on_its_way())
    meanings.insert(meanings.end(), {"viscosity of the cell (mPa s)", "place behind the contraction (um)", "number"});
  if (spec.kind == CellKind::combined) meanings.insert(meanings.end(), {cortex, "tension of the cortex (mN/m)"});
  for (std::size_t k = 0; k < meanings.size(); ++k)
    file.add_metadata(fmt::format("user:rheocyte userdef{}", k + 1), fmt::format("true {}", meanings[k]));
  if (spec.axial_tension_Pa || spec.rest_aspect)
    file.add_metadata(elongation_key, spec.rest_aspect ? meaning_of_aspect : meaning_of_tension);
  file.add_metadata("user:rheocyte shapes", shapes.description());
  if (!spec.made_of.empty()) file.add_metadata(made_of_key, spec.made_of);
  file.add_metadata("user:rheocyte seed", static_cast<std::int64_t>(spec.seed));
  file.add_metadata("user:rheocyte cells drawn", static_cast<std::int64_t>(result.cells));
  for (std::size_t k = 0; k < result.missing.size(); ++k)
    if (result.missing[k] > 0)
      file.add_metadata(fmt::format("user:rheocyte cells {}", names_of_missing_shapes[k]),
                        static_cast<std::int64_t>(result.missing[k]));
}

void write_block(Block& block, ImageSize size, RecordingFile& file) {
  for (auto& [name, values] : block.columns) {
    file.append(name, values);
    values.clear();
  }
  file.append_images("mask", size, block.masks);
  file.append_images("image", size, block.images);
  block.masks.clear();
  block.images.clear();
  block.events = 0;
}

std::string reasons(const VirtualRecording& result) {
  std::string text;
  for (std::size_t k = 0; k < result.missing.size(); ++k)
    if (result.missing[k] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", result.missing[k], names_of_missing_shapes[k]);
  return text;
}

}  // namespace

std::optional<Elongation> elongation_of_cells(const Metadata& metadata) {
  const auto meaning = metadata.text(elongation_key);
  if (meaning == meaning_of_tension) return Elongation::by_tension;
  if (meaning == meaning_of_aspect) return Elongation::by_rest_shape;
  return {};
}

std::string_view noun_of_missing(const VirtualRecording& result) {
  return result.pictures == result.cells ? "cells" : "pictures of cells";
}

VirtualRecording write_virtual_recording(const SynthSpec& spec, const CellShapes& shapes,
                                         const RecordingProvenance& provenance, const std::filesystem::path& path,
                                         const std::function<void(double)>& on_progress) {
  VirtualRecording result;
  RecordingFile file(path);
  write_metadata(spec, provenance, file);
  VirtualCamera camera(spec, shapes, result);
  Block block;
  const auto cells = static_cast<std::uint64_t>(spec.cells);
  constexpr std::size_t max_block_bytes = 64 << 20;
  const std::size_t step = std::clamp<std::size_t>(max_block_bytes / spec.image_size().pixels(), 1, cells_per_block);
  for (std::uint64_t number = 0; number < cells; ++number) {
    camera.take(number, block);
    if (block.events >= step) write_block(block, spec.image_size(), file);
    if (number % 64 == 63) on_progress(static_cast<double>(number) / static_cast<double>(cells));
  }
  write_block(block, spec.image_size(), file);
  if (result.events == 0)
    throw UserError(fmt::format("None of the {} {} can be recorded: {}; the shapes come from the {}.", result.pictures,
                                noun_of_missing(result), reasons(result), shapes.description()));
  result.mean_area_error /= static_cast<double>(result.events);
  result.mean_deformation_error /= static_cast<double>(result.events);
  describe_truth(spec, shapes, result, file);
  file.add_log("rheocyte-synth", lines_of(provenance.spec));
  file.close();
  return result;
}

}  // namespace rheocyte
