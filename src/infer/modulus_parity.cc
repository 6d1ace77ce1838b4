#include "infer/modulus_parity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "measurement/pixelation.h"

namespace rheocyte {

namespace {

std::vector<PlanePoint> normalised(const PublishedTable& table, double size, double deformation) {
  std::vector<PlanePoint> points(table.size.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {table.size[i] / size, table.deformation[i] / deformation};
  return points;
}

// Copies the deformations without the pixels' part.
void correct(const PublishedTable& table, double pixel_size_um, std::span<const double> size,
             std::span<const double> measured, std::span<double> corrected) {
  std::ranges::copy(measured, corrected.begin());
  if (pixel_size_um == 0) return;
  if (table.abscissa == Abscissa::area) return remove_pixelation(size, pixel_size_um, corrected);
  for (std::size_t i = 0; i < size.size(); ++i) corrected[i] -= deformation_by_pixels_at_volume(size[i], pixel_size_um);
}

}  // namespace

ParityModulus::ParityModulus(PublishedTable table)
    : table_(std::move(table)),
      greatest_size_(std::ranges::max(table_.size)),
      greatest_deformation_(std::ranges::max(table_.deformation)),
      triangulation_(normalised(table_, greatest_size_, greatest_deformation_), table_.modulus_kPa) {}

double ParityModulus::size_scale(const MeasuringConditions& conditions) const {
  const double ratio = table_.channel_width_um / conditions.channel_width_um;
  const double power = table_.abscissa == Abscissa::area ? ratio * ratio : ratio * ratio * ratio;
  return power / greatest_size_;
}

void ParityModulus::moduli(const MeasuringConditions& conditions, const MeasuredEvents& events,
                           std::span<double> modulus_kPa) const {
  assert(events.size.size() == modulus_kPa.size() && events.deformation.size() == modulus_kPa.size());
  assert(events.viscosity_mPas.size() == 1 || events.viscosity_mPas.size() == modulus_kPa.size());
  constexpr std::size_t block = 512;  // its columns stay in the fastest memory
  std::array<double, block> x_columns{}, y_columns{};
  const double width_ratio = table_.channel_width_um / conditions.channel_width_um;
  const double size_factor = size_scale(conditions), deformation_factor = 1 / greatest_deformation_;
  const double modulus_factor = conditions.flow_rate_ul_s / table_.flow_rate_ul_s / table_.viscosity_mPas *
                                width_ratio * width_ratio * width_ratio;
  const bool one_viscosity = events.viscosity_mPas.size() == 1;
  for (std::size_t first = 0; first < modulus_kPa.size(); first += block) {
    const std::size_t count = std::min(block, modulus_kPa.size() - first);
    const std::span<double> x(x_columns.data(), count), y(y_columns.data(), count);
    const auto size = events.size.subspan(first, count);
    const auto result = modulus_kPa.subspan(first, count);
    correct(table_, conditions.pixel_size_um, size, events.deformation.subspan(first, count), y);
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = size[i] * size_factor;
      y[i] *= deformation_factor;
    }
    triangulation_.interpolate(x, y, result);
    for (std::size_t i = 0; i < count; ++i)
      result[i] *= modulus_factor * events.viscosity_mPas[one_viscosity ? 0 : first + i];
  }
}

ModulusState ParityModulus::state(const MeasuringConditions& conditions, double size, double deformation,
                                  double modulus_kPa) const {
  if (std::isfinite(modulus_kPa)) return ModulusState::valid;
  if (!std::isfinite(size) || !std::isfinite(deformation)) return ModulusState::no_data;
  double corrected = 0;
  correct(table_, conditions.pixel_size_um, {&size, 1}, {&deformation, 1}, {&corrected, 1});
  const double x = size * size_scale(conditions), y = corrected / greatest_deformation_;
  if (x < triangulation_.least_x()) return ModulusState::too_small;
  if (x > triangulation_.greatest_x()) return ModulusState::too_large;
  const auto border = triangulation_.border_at(x);
  if (y < 0.5 * (border.lower + border.upper))
    return y > border.lower ? ModulusState::no_data : ModulusState::too_stiff;
  return y < border.upper ? ModulusState::no_data : ModulusState::too_soft;
}

}  // namespace rheocyte
