#include "population/event_bins.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace rheocyte {

std::vector<SampleEvent> binned(const std::vector<SampleEvent>& events, const BinWidths& widths) {
  using Bin = std::array<std::int64_t, 3>;
  struct Content {
    double count = 0;
    double viscosities = 0;  ///< sum of the distances from the bin's middle
  };
  const auto number = [](double value, double width) { return std::int64_t(std::floor(value / width)); };
  const auto middle = [](std::int64_t bin, double width) { return (double(bin) + 0.5) * width; };
  std::map<Bin, Content> bins;
  for (const SampleEvent& e : events) {
    const Bin bin{number(e.log_area, widths.log_area), number(e.measure, widths.measure),
                  number(e.log_viscosity, widths.log_viscosity)};
    Content& content = bins[bin];
    content.count += e.count;
    content.viscosities += e.count * (e.log_viscosity - middle(bin[2], widths.log_viscosity));
  }
  std::vector<SampleEvent> all;
  all.reserve(bins.size());
  for (const auto& [bin, content] : bins)
    all.push_back({middle(bin[0], widths.log_area), middle(bin[1], widths.measure),
                   middle(bin[2], widths.log_viscosity) + content.viscosities / content.count, content.count});
  return all;
}

}  // namespace rheocyte
