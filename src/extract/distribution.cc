#include "extract/distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numeric/no_value.h"
#include "numeric/quantile.h"

namespace rheocyte {

Distribution distribution_of(std::span<const double> values) {
  if (values.empty()) return {no_value, no_value, no_value, no_value, no_value, no_value};
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const CountedSample sample(values);
  return {sample.quantile(0.5),
          sample.quantile(0.25),
          sample.quantile(0.75),
          mean,
          values.size() > 1 ? std::sqrt(squares / (count - 1)) : no_value,
          error_of_median(sample)};
}

std::string median_text(const Distribution& d) {
  const std::string median = fmt::format("{:.4g}", d.median);
  return std::isfinite(d.median_error) ? fmt::format("{} +- {:.2g}", median, d.median_error) : median;
}

}  // namespace rheocyte
