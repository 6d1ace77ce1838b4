#include "experiment/shared_spreads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "experiment/solid_populations.h"
#include "population/shared_spread.h"

namespace rheocyte {
namespace {

constexpr double p_of_other_spreads = 0.01;

bool has_free_law(const FittedCells& fitted) { return std::ranges::none_of(fitted.at_bound, std::identity()); }

void take(const RecordingLaw& law, double level, RecordingReport& r) {
  r.fitted.cells = CellDistribution::of(law.parameters);
  r.fitted.covariance = law.covariance;
  for (int k = 0; k < population_parameters; ++k)
    r.fitted.intervals[std::size_t(k)] = normal_interval(law.parameters(k), std::sqrt(law.covariance(k, k)), level);
  tell_quantities(r);
}

}  // namespace

std::vector<std::string> share_spreads(const std::vector<PopulationCondition>& conditions, double level,
                                       std::vector<RecordingReport>& recordings) {
  std::vector<std::string> remarks;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    std::vector<RecordingReport*> sharing;
    std::vector<RecordingLaw> laws;
    for (RecordingReport& r : recordings) {
      if (r.condition != c || !r.failure.empty()) continue;
      if (!has_free_law(r.fitted)) {
        r.warnings.emplace_back("a spread is at its bound; the recording keeps its own spreads.");
        continue;
      }
      sharing.push_back(&r);
      laws.push_back({r.fitted.cells.parameters(), r.fitted.covariance});
    }
    const SpreadsApart apart = share_spread(laws);
    for (std::size_t j = 0; j < sharing.size(); ++j) take(laws[j], level, *sharing[j]);
    if (apart.p < p_of_other_spreads)
      remarks.push_back(fmt::format(
          "the cells of the recordings of {} scatter differently (p = {:.1g}): one spread is not that of each.",
          conditions[c].name, apart.p));
  }
  return remarks;
}

}  // namespace rheocyte
