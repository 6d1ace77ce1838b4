#include "infer/solid_features.h"

#include <cmath>

namespace rheocyte {

SolidFeatures features_of(const ElongatedState& s, double length_factor) {
  const auto value = [&](ElongatedMeasure m) { return s.value(number_of(m)); };
  using enum ElongatedMeasure;
  constexpr int second = number_of(mode_2);
  return {s.log_area() + 2 * std::log(length_factor),
          value(deformation),
          value(inertia_ratio),
          {s.value(second), s.value(second + 1), s.value(second + 2), s.value(second + 3)}};
}

Eigen::Matrix3d noise_of(const SolidFeatures& seen, StiffnessMeasure by, double pixel_size_um) {
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  const double log_area_px = seen.log_area - 2 * std::log(pixel_size_um);
  const PixelErrors pixels = pixel_errors(log_area_px, seen.deformation);
  noise(0, 0) = std::pow(pixels.area_deviation, 2);
  const auto set = [&](double second, double third, double correlation) {
    noise(1, 1) = second * second;
    noise(2, 2) = third * third;
    noise(1, 2) = noise(2, 1) = correlation * second * third;
  };
  switch (by) {
    case StiffnessMeasure::asymmetry: {
      const ModeErrors modes = mode_errors(log_area_px, seen.modes);
      set(modes.mode_2.deviation, modes.mode_3.deviation, modes.correlation);
      break;
    }
    case StiffnessMeasure::odd_deformation: {
      const InertiaErrors e = inertia_errors(log_area_px, seen.deformation, seen.inertia_ratio);
      set(e.inertia_deviation, e.deformation_deviation, e.correlation);
      break;
    }
    case StiffnessMeasure::deformation:
      noise(2, 2) = std::pow(pixels.deformation_deviation, 2);
      noise(0, 2) = noise(2, 0) = pixels.correlation * pixels.area_deviation * pixels.deformation_deviation;
  }
  return noise;
}

double elongation_of(const SolidFeatures& f, StiffnessMeasure by) {
  return by == StiffnessMeasure::odd_deformation ? f.inertia_ratio : f.modes.mode_2;
}
double measure_of(const SolidFeatures& f, StiffnessMeasure by) {
  return by == StiffnessMeasure::asymmetry ? f.modes.mode_3 : f.deformation;
}

SolidFeatures through_pixels(const SolidFeatures& smooth, StiffnessMeasure by, double pixel_size_um) {
  SolidFeatures seen = smooth;
  const double log_pixel_area = 2 * std::log(pixel_size_um);
  constexpr int steps = 8;
  // The errors are small and change little: each step gains two digits.
  for (int step = 0; step < steps; ++step) {
    const double log_area_px = seen.log_area - log_pixel_area;
    const PixelErrors pixels = pixel_errors(log_area_px, seen.deformation);
    const ModeErrors errors = mode_errors(log_area_px, seen.modes);
    const double deformation_excess =
        by == StiffnessMeasure::deformation ? pixels.deformation_excess : errors.deformation_excess;
    const OutlineModes& modes = smooth.modes;
    seen = {smooth.log_area - std::log(pixels.area_factor),
            smooth.deformation + deformation_excess,
            smooth.inertia_ratio + errors.inertia_excess,
            {modes.mode_2 + errors.mode_2.excess, modes.mode_3 + errors.mode_3.excess,
             modes.mode_4 + errors.mode_4.excess, modes.mode_5 + errors.mode_5.excess}};
  }
  return seen;
}

}  // namespace rheocyte
