#include "events/events_beyond.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "case/joined.h"

namespace rheocyte {
namespace {

constexpr std::array<std::string_view, std::size_t(TableSide::count)> side_names{"softer", "longer", "rounder",
                                                                                 "smaller", "larger"};

double percent_of(std::size_t part, std::size_t all) { return 100 * double(part) / double(all); }

}  // namespace

std::string_view name_of(TableSide side) { return side_names[std::size_t(side)]; }

void EventsBeyond::add(const EventsBeyond& others) {
  for (std::size_t k = 0; k < counts_.size(); ++k) counts_[k] += others.counts_[k];
}

std::size_t EventsBeyond::all() const { return std::accumulate(counts_.begin(), counts_.end(), std::size_t(0)); }

std::string EventsBeyond::shares(std::size_t events) const {
  constexpr double worth_a_word = 0.5;  // per cent
  std::vector<std::string> shares;
  for (std::size_t k = 0; k < counts_.size(); ++k)
    if (counts_[k] > 0 && percent_of(counts_[k], events) >= worth_a_word)
      shares.push_back(fmt::format("{:.0f} % {}", percent_of(counts_[k], events), side_names[k]));
  return joined(shares, " and ");
}

std::string EventsBeyond::majority(std::size_t events) const {
  using enum TableSide;
  const std::array<std::pair<std::size_t, std::string_view>, 4> sides{
      {{on(softer) + on(longer), on(longer) == 0   ? "softer"
                                 : on(softer) == 0 ? "longer"
                                                   : "softer or longer"},
       {on(rounder), "rounder"},
       {on(smaller), "smaller"},
       {on(larger), "larger"}}};
  for (const auto& [count, name] : sides)
    if (2 * count > events) return fmt::format("{:.0f} % of {} events are {}", percent_of(count, events), events, name);
  return {};
}

std::optional<double> bound_of_median(std::vector<double> below, std::size_t all) {
  const std::size_t middle = all / 2;  // so many of all lie below the median
  if (below.size() <= middle) return {};
  std::ranges::nth_element(below, below.begin() + std::ptrdiff_t(middle));
  return below[middle];
}

}  // namespace rheocyte
