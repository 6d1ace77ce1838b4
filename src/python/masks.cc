// Features of the outlines in masks.
#include <pybind11/numpy.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "measurement/contour_tilt.h"
#include "numeric/no_value.h"
#include "python/bindings.h"
#include "python/interruptible.h"
#include "shape/outline_shape.h"
#include "shape/radius_modes.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

using Masks = py::array_t<std::uint8_t, py::array::c_style>;

struct Found {
  std::vector<ContourFeatures> features;
  std::vector<RadiusModes> modes;
  std::vector<OutlineTilt> tilt;
};

// Names and values (names, events) of masks (events, rows, columns), not empty; the caller has looked.
py::tuple features(const Masks& masks, double pixel_size_um) {
  const auto count = static_cast<std::size_t>(masks.shape(0));
  const ImageSize size{static_cast<std::size_t>(masks.shape(2)), static_cast<std::size_t>(masks.shape(1))};
  const std::uint8_t* const pixels = masks.data();
  const auto found = interruptible([&](const std::atomic<bool>& stop) {
    Found all;
    RadiusModes no_modes;
    no_modes.fill(no_value);
    ContourFinder finder;
    ContourMeasurer measurer;
    all.features.reserve(count);
    all.modes.reserve(count);
    for (std::size_t i = 0; i < count && !stop; ++i) {
      const PixelContour& contour = finder.contour_of({size, {pixels + i * size.pixels(), size.pixels()}});
      all.features.push_back(measurer.measure(contour, pixel_size_um));
      const bool is_cell = std::isfinite(all.features.back().area_um2);
      all.modes.push_back(is_cell ? hull_modes(measurer.hull()) : no_modes);
      all.tilt.push_back(is_cell ? contour_tilt(contour, measurer.hull(), 1, size) : OutlineTilt{});
    }
    return all;
  });
  py::list names;
  py::array_t<double> columns(
      {outline_features().size() + std::tuple_size_v<RadiusModes> + tilt_features().size(), count});
  double* values = columns.mutable_data();
  for (const OutlineFeature& feature : outline_features()) {
    names.append(feature.name);
    values = std::ranges::transform(found.features, values, feature.value).out;
  }
  for (int k = first_radius_mode; k <= last_radius_mode; ++k) {
    names.append("mode_" + std::to_string(k));
    const auto place = std::size_t(k - first_radius_mode);
    values = std::ranges::transform(found.modes, values, [place](const RadiusModes& m) { return m[place]; }).out;
  }
  for (const TiltFeature& feature : tilt_features()) {
    names.append(feature.name);
    values = std::ranges::transform(found.tilt, values, feature.value).out;
  }
  return py::make_tuple(names, columns);
}

}  // namespace

const Binding bind_masks([](py::module_& module) { module.def("features", &features); });

}  // namespace rheocyte
