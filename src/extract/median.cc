#include "extract/median.h"

#include <cmath>

#include "numeric/quantile.h"

namespace rheocyte {

Median median_with_error(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return {no_value, no_value};
  const CountedSample<double> sample(values);
  return {sample.quantile(0.5), error_of_median(sample)};
}

}  // namespace rheocyte
