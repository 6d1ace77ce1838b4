#include "population/stiffening.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>

namespace rheocyte {
namespace {

constexpr double least_log_ratio = 0.05;

}  // namespace

bool differ_in_stress(std::span<const MeanAtStress> means) {
  if (means.empty()) return false;
  const auto [least, greatest] = std::ranges::minmax(means, {}, &MeanAtStress::log_stress);
  return greatest.log_stress - least.log_stress > least_log_ratio;
}

Stiffening stiffening_of(std::span<const MeanAtStress> means, double level) {
  assert(differ_in_stress(means));
  const double count = double(means.size());
  double stress = 0, value = 0;
  for (const auto& m : means) stress += m.log_stress / count, value += m.mean.value / count;
  double squares = 0, products = 0, sampling = 0;
  for (const auto& m : means) {
    const double off = m.log_stress - stress;
    squares += off * off;
    products += off * (m.mean.value - value);
    sampling += off * off * m.mean.variance;
  }
  Stiffening found;
  found.exponent = products / squares;
  found.value = value;
  const double z = boost::math::quantile(boost::math::normal(), (1 + level) / 2) * std::sqrt(sampling) / squares;
  found.sampling_lower = found.exponent - z;
  found.sampling_upper = found.exponent + z;
  if (means.size() < 3) return found;
  found.freedom = count - 2;
  double residues = 0;
  for (const auto& m : means) residues += std::pow(m.mean.value - value - found.exponent * (m.log_stress - stress), 2);
  const double deviation = std::sqrt(residues / found.freedom),
               t = boost::math::quantile(boost::math::students_t(found.freedom), (1 + level) / 2);
  const double reach = t * deviation / std::sqrt(squares), of_value = t * deviation / std::sqrt(count);
  found.lower = found.exponent - reach;
  found.upper = found.exponent + reach;
  found.value_lower = value - of_value;
  found.value_upper = value + of_value;
  return found;
}

}  // namespace rheocyte
