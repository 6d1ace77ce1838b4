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

/// Between which the parameters are searched; the means within what the sample's maps can have.
struct ParameterBounds {
  ParameterVector least, greatest;
};

}  // namespace rheocyte
