#include "population/sample.h"

#include <algorithm>
#include <cmath>

namespace rheocyte {

double LimitCurve::at(double log_area) const {
  if (values.empty()) return std::numeric_limits<double>::infinity();
  const double place = std::clamp((log_area - first) / step, 0.0, double(values.size() - 1));
  const std::size_t below = std::min(std::size_t(place), values.size() < 2 ? 0 : values.size() - 2);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], place - double(below));
}

double Sample::events() const {
  double sum = 0;
  for (const auto& group : groups)
    for (const auto& event : group.events) sum += event.count;
  return sum;
}

bool Sample::is_of_one_elongation() const {
  return std::ranges::all_of(groups, [&](const EventGroup& g) { return g.elongation == groups.front().elongation; });
}

std::size_t Sample::bins() const {
  std::size_t sum = 0;
  for (const auto& group : groups) sum += group.events.size();
  return sum;
}

}  // namespace rheocyte
