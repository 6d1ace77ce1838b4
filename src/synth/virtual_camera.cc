#include "synth/virtual_camera.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "measurement/mask_from_outline.h"
#include "measurement/outline_noise.h"
#include "numeric/cell_random.h"
#include "synth/outline.h"
#include "synth/pixel_picture.h"

namespace rheocyte {

namespace {

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

}  // namespace

VirtualCamera::VirtualCamera(const SynthSpec& spec, const CellShapes& shapes, VirtualRecording& result)
    : spec_(spec), shapes_(shapes), size_(spec.image_size()), result_(result), mask_(size_.pixels()) {
  if (!spec.viscosity_mPas) buffer_.emplace(*medium_of_name(spec.medium), spec.viscosity_model);
}

void VirtualCamera::take(std::uint64_t number, VirtualEvents& block) {
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

std::pair<VirtualCell, double> VirtualCamera::drawn(std::uint64_t number) const {
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

void VirtualCamera::see(const VirtualCell& cell, const Picture& picture, VirtualEvents& block) {
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

Eigen::MatrixX2d VirtualCamera::outline_in_picture(const CellShape& shape, const VirtualCell& cell,
                                                   std::uint64_t number) {
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

void VirtualCamera::add_features(const ContourFeatures& features, VirtualEvents& block) const {
  for (const auto& feature : features_of_outlines)
    block.columns[feature.name].push_back(feature.value(features, spec_.pixel_size_um));
}

void VirtualCamera::add_truth(const VirtualCell& cell, const CellShape& shape, const ContourFeatures& features,
                              VirtualEvents& block) {
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

void VirtualCamera::arrive(std::uint64_t number) {
  auto arrival = CellRandom(seed(), number, Purpose::arrival);
  frame_ += 1 + std::floor(-std::log(arrival.uniform()) * spec_.frame_rate_Hz / spec_.cells_per_s);
}

void VirtualCamera::add_time(const CellShape& shape, const Picture& picture, VirtualEvents& block) {
  if (!spec_.is_on_its_way()) arrive(picture.cell);
  const double frame = frame_ + shape.time_s * spec_.frame_rate_Hz;  // on its way a cell is taken at its places
  block.columns["frame"].push_back(std::floor(frame));
  block.columns["time"].push_back(frame / spec_.frame_rate_Hz);
  block.columns["index"].push_back(static_cast<double>(result_.events));
  auto thermometer = CellRandom(seed(), picture.number, Purpose::thermometer);
  if (buffer_) block.columns["temp"].push_back(picture.celsius + spec_.thermometer_C * thermometer.normal());
}

void VirtualCamera::add_pictures(const Eigen::MatrixX2d& outline, std::uint64_t number, VirtualEvents& block) const {
  if (spec_.pictures == Pictures::none) return;
  block.masks.insert(block.masks.end(), mask_.begin(), mask_.end());
  if (spec_.pictures != Pictures::images) return;
  auto random = CellRandom(seed(), number, Purpose::picture);
  block.images.resize(block.images.size() + size_.pixels());
  draw_grey(outline, {spec_.pixel_size_um, axis(), spec_.channel_width_um}, size_, random,
            std::span(block.images).last(size_.pixels()));
}

}  // namespace rheocyte
