// The normal distribution of cells of which each is known by what it may be, and how likely.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace rheocyte {

/// What one cell could be, and how likely that is (not normalised).
struct LikelyCells {
  std::vector<double> log_modulus, log_viscosity, weight;  ///< kPa, Pa s
};

/// Means and variances of ln(E) and ln(viscosity) in a population.
struct CourseNormal {
  Eigen::Array2d mean = Eigen::Array2d::Zero(), variance = Eigen::Array2d::Ones();
};

/// Where the search for it starts: as if each cell were what it is most likely alone.
CourseNormal first_guess(const std::vector<LikelyCells>& cells);

/// By expectation and maximisation (Dempster, Laird and Rubin 1977).
CourseNormal most_likely(const std::vector<LikelyCells>& cells, CourseNormal start);

/// Standard errors of the means, from the scatter of the cells' scores. A variance that is as small as any is not
/// estimated.
Eigen::Array2d errors_of(const std::vector<LikelyCells>& cells, const CourseNormal& population);

}  // namespace rheocyte
