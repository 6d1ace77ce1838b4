#include "infer/published_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <sstream>
#include <utility>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "measurement/pixelation.h"
#include "numeric/no_value.h"
#include "store/read_file.h"
#include "table/scale.h"

namespace rheocyte {

namespace {

std::vector<PlanePoint> normalised(const PublishedTable& table, double size, double deformation) {
  std::vector<PlanePoint> points(table.size.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {table.size[i] / size, table.deformation[i] / deformation};
  return points;
}

}  // namespace

PublishedTable read_published_table(const std::filesystem::path& file, const char* identifier_key) {
  const TableText text = read_table_text(file);
  const auto refuse = [&](const std::string& reason) { refuse_path(file, reason); };
  const auto identifier = text.metadata.find(identifier_key);
  if (identifier == text.metadata.end() || !identifier->is_string())
    refuse(fmt::format("the metadata need a text \"{}\".", identifier_key));
  PublishedTable table{.identifier = one_line(identifier->get<std::string>(), 100),
                       .flow = channel_flow_of(text),
                       .abscissa = text.abscissa};
  for (const auto& [size, deformation, modulus] : text.rows) {
    table.size.push_back(size);
    table.deformation.push_back(deformation);
    table.modulus_kPa.push_back(modulus);
  }
  if (text.rows.size() < 3) refuse("has fewer than three rows.");
  if (!(std::ranges::max(table.deformation) > 0)) refuse("no row has a positive deformation.");
  return table;
}

std::string published_identifier(const std::filesystem::path& file) {
  constexpr std::size_t longest_head = std::size_t{64} << 10U;
  const std::string quoted = fmt::format("\"{}\"", table_identifier_key);
  std::istringstream stream(first_bytes(file, longest_head).value_or(""));
  for (std::string line; std::getline(stream, line) && line.starts_with('#');) {
    const auto key = line.find(quoted);
    if (key == std::string::npos) continue;
    const auto start = line.find('"', line.find(':', key));
    const auto end = start == std::string::npos ? start : line.find('"', start + 1);
    if (end != std::string::npos) return line.substr(start + 1, end - start - 1);
  }
  return {};
}

PlanePoint with_pixelation(const PlanePoint& cell, double pixel_size_um) {
  return {cell.x, cell.y + deformation_by_pixels_at_area(cell.x, pixel_size_um)};
}

void refuse_volumes(const PublishedTable& table) {
  if (table.abscissa != Abscissa::area)
    throw UserError(fmt::format("The table {} contains volumes; recordings and pictures need a table of areas.",
                                one_line(table.identifier, 100)));
}

PublishedMap::PublishedMap(PublishedTable table)
    : ModulusMap({.identifier = table.identifier, .model = {}, .program = {}, .spec = {}, .flow = table.flow}),
      abscissa_(table.abscissa),
      max_size_(std::ranges::max(table.size)),
      max_deformation_(std::ranges::max(table.deformation)),
      triangulation_(normalised(table, max_size_, max_deformation_), table.modulus_kPa) {}

double PublishedMap::size_scale(const MeasuringConditions& conditions) const {
  const ScaleFactors to_table = scale_factors(conditions.flow, origin().flow);
  return (abscissa_ == Abscissa::area ? to_table.area : to_table.volume) / max_size_;
}

// Copies the deformations without the pixels' part.
void PublishedMap::correct(double pixel_size_um, std::span<const double> size, std::span<const double> measured,
                           std::span<double> corrected) const {
  std::ranges::copy(measured, corrected.begin());
  if (pixel_size_um == 0) return;
  if (abscissa_ == Abscissa::area) return remove_pixelation(size, pixel_size_um, corrected);
  for (std::size_t i = 0; i < size.size(); ++i) corrected[i] -= deformation_by_pixels_at_volume(size[i], pixel_size_um);
}

void PublishedMap::estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                            const EstimatedModuli& estimates) const {
  moduli(conditions, events, estimates.modulus_kPa);
  std::ranges::fill(estimates.standard_error_kPa, no_value);
  for (std::size_t i = 0; i < estimates.state.size(); ++i)
    estimates.state[i] = state(conditions, events.size[i], events.deformation[i], estimates.modulus_kPa[i]);
}

void PublishedMap::moduli(const MeasuringConditions& conditions, const MeasuredEvents& events,
                          std::span<double> modulus_kPa) const {
  assert(events.size.size() == modulus_kPa.size() && events.deformation.size() == modulus_kPa.size());
  assert(events.viscosity_mPas.size() == 1 || events.viscosity_mPas.size() == modulus_kPa.size());
  constexpr std::size_t block = 512;  // its columns stay in the fastest memory
  std::array<double, block> x_columns{}, y_columns{};
  const double size_factor = size_scale(conditions), deformation_factor = 1 / max_deformation_;
  const double modulus_factor = factor_per_mPas(conditions);
  const bool one_viscosity = events.viscosity_mPas.size() == 1;
  for (std::size_t first = 0; first < modulus_kPa.size(); first += block) {
    const std::size_t count = std::min(block, modulus_kPa.size() - first);
    const std::span<double> x(x_columns.data(), count), y(y_columns.data(), count);
    const auto size = events.size.subspan(first, count);
    const auto result = modulus_kPa.subspan(first, count);
    correct(conditions.pixel_size_um, size, events.deformation.subspan(first, count), y);
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = size[i] * size_factor;
      y[i] *= deformation_factor;
    }
    triangulation_.interpolate(x, y, result);
    for (std::size_t i = 0; i < count; ++i)
      result[i] *= modulus_factor * events.viscosity_mPas[one_viscosity ? 0 : first + i];
  }
}

ModulusState PublishedMap::state(const MeasuringConditions& conditions, double size, double deformation,
                                 double modulus_kPa) const {
  if (std::isfinite(modulus_kPa)) return ModulusState::valid;
  if (!std::isfinite(size) || !std::isfinite(deformation)) return ModulusState::no_data;
  double corrected = 0;
  correct(conditions.pixel_size_um, {&size, 1}, {&deformation, 1}, {&corrected, 1});
  const double x = size * size_scale(conditions), y = corrected / max_deformation_;
  if (x < triangulation_.min_x()) return ModulusState::too_small;
  if (x > triangulation_.max_x()) return ModulusState::too_large;
  const auto border = triangulation_.border_at(x);
  if (y < 0.5 * (border.lower + border.upper))
    return y > border.lower ? ModulusState::no_data : ModulusState::too_stiff;
  return y < border.upper ? ModulusState::no_data : ModulusState::too_soft;
}

ModulusMap::Interval PublishedMap::areas() const {
  return {triangulation_.min_x() * max_size_, triangulation_.max_x() * max_size_};
}

ModulusMap::Interval PublishedMap::deformations(double area_um2) const {
  const double x = std::clamp(area_um2 / max_size_, triangulation_.min_x(), triangulation_.max_x());  // rounding
  const auto border = triangulation_.border_at(x);
  return {border.lower * max_deformation_, border.upper * max_deformation_};
}

double PublishedMap::modulus_kPa(double area_um2, double deformation) const {
  const double x = area_um2 / max_size_, y = deformation / max_deformation_;
  double modulus = no_value;
  triangulation_.interpolate({&x, 1}, {&y, 1}, {&modulus, 1});
  return modulus;
}

PlanePoint PublishedMap::seen_through_pixels(const PlanePoint& cell, double pixel_size_um) const {
  return with_pixelation(cell, pixel_size_um);
}

}  // namespace rheocyte
