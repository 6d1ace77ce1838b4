#include "population/stiffening.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "population/statistics_laws.h"

namespace rheocyte {
namespace {

constexpr double least_log_ratio = 0.05;

}  // namespace

int distinct_stresses(std::span<const MeanAtStress> means) {
  std::vector<double> stresses;
  for (const auto& m : means) stresses.push_back(m.log_stress);
  std::ranges::sort(stresses);
  int distinct = 0;
  double last = -HUGE_VAL;
  for (const double stress : stresses)
    if (stress - last > least_log_ratio) ++distinct, last = stress;
  return distinct;
}

Stiffening stiffening_of(std::span<const MeanAtStress> means, double level) {
  assert(distinct_stresses(means) >= fewest_stresses_of_a_power);
  const double count = double(means.size());
  double stress = 0, value = 0;
  for (const auto& m : means) stress += m.log_stress / count, value += m.mean.value / count;
  double squares = 0, products = 0, of_exponent = 0, of_value = 0;  // the last two by sampling, variances
  for (const auto& m : means) {
    const double off = m.log_stress - stress;
    squares += off * off;
    products += off * (m.mean.value - value);
    of_exponent += off * off * m.mean.variance;
    of_value += m.mean.variance / (count * count);
  }
  Stiffening found{.exponent = products / squares, .value = value, .freedom = count - 2};
  double residues = 0;
  for (const auto& m : means) residues += std::pow(m.mean.value - value - found.exponent * (m.log_stress - stress), 2);
  const double deviation = std::sqrt(residues / found.freedom), t = students_t_quantile(found.freedom, (1 + level) / 2),
               z = normal_quantile((1 + level) / 2);
  const double reach = std::max(t * deviation, z * std::sqrt(of_exponent / squares)) / std::sqrt(squares),
               reach_of_value = std::max(t * deviation / std::sqrt(count), z * std::sqrt(of_value));
  found.lower = found.exponent - reach;
  found.upper = found.exponent + reach;
  found.value_lower = value - reach_of_value;
  found.value_upper = value + reach_of_value;
  return found;
}

}  // namespace rheocyte
