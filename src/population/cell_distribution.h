// The law of a recording's cells: ln of radius and modulus are normally distributed.
#pragma once
#include <Eigen/Core>
#include <cmath>

namespace rheocyte {

/// mean of ln(r0 / um) and ln(E / kPa), ln of both standard deviations, artanh of the correlation.
inline constexpr int population_parameters = 5;
using ParameterVector = Eigen::Matrix<double, population_parameters, 1>;
using ParameterMatrix = Eigen::Matrix<double, population_parameters, population_parameters>;
enum class PopulationParameter {
  mean_log_radius,
  mean_log_modulus,
  log_radius_spread,
  log_modulus_spread,
  correlation
};
constexpr int number_of(PopulationParameter parameter) { return int(parameter); }

struct CellDistribution {
  double mean_log_radius = 0, mean_log_modulus = 0;
  double radius_spread = 0.1, modulus_spread = 0.2;  ///< standard deviations of the logarithms
  double correlation = 0;

  static CellDistribution of(const ParameterVector& q) {
    return {q(0), q(1), std::exp(q(2)), std::exp(q(3)), std::tanh(q(4))};
  }
  ParameterVector parameters() const {
    ParameterVector q;
    q << mean_log_radius, mean_log_modulus, std::log(radius_spread), std::log(modulus_spread), std::atanh(correlation);
    return q;
  }
};

/// The mean goes with the elongation of a cell: the longer ones of a recording are the softer ones, if one tension
/// draws them all out. What is searched for: the parameters of the cells of elongation 0, and both slopes of the mean.
inline constexpr int law_parameters = population_parameters + 2;
using LawVector = Eigen::Matrix<double, law_parameters, 1>;
using LawMatrix = Eigen::Matrix<double, law_parameters, law_parameters>;

struct CellLaw {
  CellDistribution usual;                      ///< at elongation 0
  double radius_slope = 0, modulus_slope = 0;  ///< of the means of ln r0 and ln E by the elongation of a sample

  static CellLaw of(const LawVector& q) {
    return {CellDistribution::of(q.head<population_parameters>()), q(population_parameters),
            q(population_parameters + 1)};
  }
  LawVector parameters() const { return (LawVector() << usual.parameters(), radius_slope, modulus_slope).finished(); }

  CellDistribution at(double elongation) const {
    CellDistribution cells = usual;
    cells.mean_log_radius += radius_slope * elongation;
    cells.mean_log_modulus += modulus_slope * elongation;
    return cells;
  }
  /// Slopes by the parameters of the law from those by the parameters of its cells at an elongation.
  static LawVector score(const ParameterVector& of_cells, double elongation) {
    return (LawVector() << of_cells, elongation * of_cells(0), elongation * of_cells(1)).finished();
  }
  /// Cells of all elongations together, with this mean and variance of the elongation.
  CellDistribution population(double mean, double variance) const;
};

/// Between which the parameters are searched; the means within what the sample's maps can have.
struct ParameterBounds {
  LawVector least, greatest;
};

}  // namespace rheocyte
