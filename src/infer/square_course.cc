#include "infer/square_course.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace rheocyte {

SquareCourse::SquareCourse(const DynamicTable& table, const ModulusMap& square)
    : table_(table), square_(square, channel_flow_of(table.spec().base)) {}

double SquareCourse::settled(CourseMeasure measure, const DynamicCell& cell) const {
  return table_.value(measure, cell, table_.spec().last_um);
}

DynamicCell SquareCourse::cell_of(double area_um2, double modulus_kPa) const {
  const auto axes = nodes_of(table_.spec());
  DynamicCell cell{std::sqrt(area_um2 / std::numbers::pi), modulus_kPa, table_.spec().min_time_ms};
  constexpr int rounds = 3;  // the area of a cell changes by some per cent
  for (int round = 0; round < rounds; ++round) {
    auto at = coordinates_of(table_.spec(), cell);
    for (std::size_t k = 0; k < at.size(); ++k) at[k] = std::clamp(at[k], axes[k].front(), axes[k].back());
    cell = cell_at(table_.spec(), at);
    if (round + 1 == rounds) break;
    cell.radius_um = std::sqrt(area_um2 / std::numbers::pi / settled(CourseMeasure::area_ratio, cell));
    cell.young_modulus_kPa = modulus_kPa;
  }
  return cell;
}

SquareCourse::Change SquareCourse::change(double area_um2, double mode_3) const {
  const double seen = square_.deformation_by_mode_3(area_um2, std::abs(mode_3));
  const DynamicCell cell = cell_of(area_um2, square_.modulus_kPa(area_um2, seen));
  const ShapeVector shape = square_.shape(area_um2, square_.deformation_by_modulus(area_um2, cell.young_modulus_kPa));
  constexpr int second = int(ShapeFeature::first_mode), third = second + 1;
  return {shape(third) / settled(CourseMeasure::mode_3, cell), shape(second) - settled(CourseMeasure::mode_2, cell)};
}

CourseImage SquareCourse::in_table(const CourseImage& image) const {
  const Change by_square = change(image.area_um2, image.mode_3);
  CourseImage moved = image;
  moved.mode_3 /= by_square.factor;
  moved.deviation /= by_square.factor;
  moved.mode_2 -= by_square.mode_2;
  moved.section_factor = by_square.factor;
  return moved;
}

double SquareCourse::unsettled() const {
  const DynamicSpec& spec = table_.spec();
  const auto axes = nodes_of(spec);
  const DynamicCell cell = cell_at(spec, {axes[0].back(), axes[1].front(), axes[2].front()});
  const double before = std::lerp(spec.first_um, spec.last_um, 2.0 / 3);
  return std::abs(1 - table_.value(CourseMeasure::mode_3, cell, before) / settled(CourseMeasure::mode_3, cell));
}

double error_left_by_section(double factor) {
  constexpr double of_tables = 0.005;  // both of them, and what is between their nodes
  return std::hypot(of_tables, left_by_section * std::log(factor));
}

}  // namespace rheocyte
