// Young's modulus and viscosity of cells from the third mode of their outlines at several places behind a contraction
// (docs/theory-extract.md, sec. "Time courses").
#pragma once
#include <functional>
#include <span>
#include <tuple>
#include <vector>

#include "numeric/no_value.h"
#include "store/watch.h"
#include "table/dynamic_table.h"

namespace rheocyte {

/// One picture of a cell, in the channel of the table.
struct CourseImage {
  double place_um = 0;  ///< behind the contraction, inside the table's places
  double area_um2 = 0;  ///< without what the pixels do, as mode_3 of a cell that moves towards +x
  double mode_3 = 0;
  double deviation = 0;  ///< standard deviation of mode_3
  /// What it has beyond that of the table's cell counts as elongated by the liquid (elongation_law.h); NaN: it has
  /// nothing.
  double mode_2 = no_value;
  /// By what mode_3 was divided because the cell flows in a square channel, and not in the tube of the table
  /// (square_course.h); what that leaves is an error of the estimates.
  double section_factor = 1;
};

/// All pictures of one cell.
using CellImages = std::vector<CourseImage>;

/// A number with the interval that holds it with a probability of 90 %.
struct Credible {
  double value = no_value, low = value, high = value;
  /// Whether it is known to better than a factor of two.
  bool is_resolved() const { return high < 4 * low; }
};

/// How much longer than a cell of the table the images of one are, in the mean: c_2 beyond the table's, and by what
/// c_3 was multiplied to be that without the tension that draws it out so (elongation_law.h).
struct DrawnOut {
  double mode_2_excess = no_value, factor = no_value;
};

inline constexpr double credible_fraction = 0.9;
inline constexpr double normal_quantile_of_credible = 1.6448536270;  ///< in standard deviations

struct CourseEstimate {
  double radius_um = no_value;
  Credible young_modulus_kPa, viscosity_Pas, time_ms;  ///< medians; time: 3 viscosity / E
  double chi_squared = no_value;
};

/// No spread of a population is distinguished from a smaller one: standard deviation of a logarithm.
inline constexpr double min_spread = 0.05;

/// Normal in ln(E) and ln(viscosity).
struct PopulationEstimate {
  Credible young_modulus_kPa, viscosity_Pas;        ///< medians of the population
  double modulus_spread = 0, viscosity_spread = 0;  ///< of the logarithms, at least min_spread
  std::size_t cells = 0;
};

class TimeCourse {
 public:
  /// The table must outlive it.
  explicit TimeCourse(const DynamicTable& table) : table_(table) {}

  /// Whether the table has cells of this area.
  bool has_area(double area_um2) const;

  /// From at least one picture; every modulus and every time of the table is as likely beforehand. Without any value if
  /// no cell of the table can be it.
  CourseEstimate cell(const CellImages& images) const;

  /// Beside the table's cell with this modulus and time and the areas of the images. Nothing if no cell of the table
  /// can be it, or no image has a c_2.
  DrawnOut drawn_out(const CellImages& images, double young_modulus_kPa, double time_ms) const;

  /// Of cells with at least one picture each, at most this many of them, evenly chosen. The intervals hold what is
  /// alike in all cells, too: what the law of the pixels leaves of c_3, at the nearer places and, independently, at the
  /// others.
  static constexpr std::size_t max_cells = 2000;
  PopulationEstimate population(std::span<const CellImages> cells, const Watch& watch = {}) const;

 private:
  struct Points;
  struct Box;
  struct Tension;
  Tension tension_of(const CourseImage& image, double radius_um, std::span<const double> log_modulus,
                     std::span<const double> log_time) const;
  Points points(const CellImages& images, const Box& box, int count) const;
  Points refined_points(const CellImages& images) const;

  const DynamicTable& table_;
};

}  // namespace rheocyte
