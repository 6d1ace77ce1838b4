// Pictures of cells in a square channel, brought to the channel and the liquid for which a dynamic table was computed
// (docs/theory-extract.md, sec. "The square channel").
#pragma once
#include "infer/square_solids.h"
#include "infer/time_course.h"

namespace rheocyte {

class SquareCourse {
 public:
  /// Both tables, of solids of one law, must outlive it.
  SquareCourse(const DynamicTable& table, const ModulusMap& square);

  /// What square and liquid do to a stationary cell: c_3 over that of the table's cell with this area and modulus, and
  /// c_2 less that cell's.
  struct Change {
    double factor = 1, mode_2 = 0;
  };
  /// Of the cell with this area (um^2, in the channel of the dynamic table) and c_3 in the square channel. Cells on
  /// their way count as the stationary ones that are as asymmetric.
  Change change(double area_um2, double mode_3) const;

  /// The picture as it would be in the table's channel and liquid.
  CourseImage in_table(const CourseImage& image) const;

  /// By how much, in parts of it, c_3 of the table's fastest cell changes on the last third of its way: this much, it
  /// is not stationary.
  double unsettled() const;

 private:
  /// Those of the dynamic table that have settled: behind the whole way, and with the least viscosity.
  double settled(CourseMeasure measure, const DynamicCell& cell) const;
  /// With this area and a modulus that the table has.
  DynamicCell cell_of(double area_um2, double modulus_kPa) const;

  const DynamicTable& table_;
  SquareSolids square_;
};

/// Standard deviation of ln(E) that is left of a correction by this factor of c_3, to which E is inversely
/// proportional.
double error_left_by_section(double factor);

/// How much faster a cell is in the tube of equal pressure drop, in parts: the times of its way, and so viscosities,
/// are off by this (docs/theory-extract.md).
inline constexpr double error_of_speed_by_section = 0.02;

}  // namespace rheocyte
