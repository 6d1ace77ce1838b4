#include "table/radius_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace rheocyte {

namespace {

/// Between equal distances and those of Chebyshev's polynomials: at both ends there are neighbours on one side only.
std::vector<int> first_places(int count) {
  constexpr int intervals = 10;
  std::set<int> places;
  for (int k = 0; k <= intervals; ++k) {
    const double even = static_cast<double>(k) / intervals, dense = (1 - std::cos(std::numbers::pi * even)) / 2;
    places.insert(static_cast<int>(std::lround((count - 1) * (even + dense) / 2)));
  }
  return {places.begin(), places.end()};
}

}  // namespace

bool can_be_regularised(const TableSpec& spec, const SampledBranch& own) {
  return spec.wants_regularised() && !own.empty() && own.end.status == Status::surface_unstable;
}

RadiusPlan::RadiusPlan(const TableSpec& spec, Records records)
    : spec_(spec), places_(sweep_places(spec)), records_(std::move(records)) {}

RadiusPlan::Branch RadiusPlan::branch(const BranchTask& task) const {
  const auto found = known_.find(task);
  return found == known_.end() ? nullptr : found->second;
}

bool RadiusPlan::update() {
  if (complete_) return true;
  missing_.clear();
  const bool own = settle(false), regularised = !spec_.wants_regularised() || settle(true);
  return complete_ = own && regularised;
}

bool RadiusPlan::settle(bool regularised) {
  Nodes nodes;
  for (auto places = places_at_first(); !places.empty(); places = next_places(nodes, regularised))
    if (!find(places, regularised, nodes)) return false;
  return true;
}

std::vector<int> RadiusPlan::places_at_first() const {
  const int count = static_cast<int>(places_.size());
  if (!spec_.is_combined() && !spec_.is_square()) return first_places(count);
  std::vector<int> all(places_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// In a square channel polynomials run through the branches of all radii: all are held as soon as one needs it.
std::optional<bool> RadiusPlan::wants_regularised(int place) const {
  bool knows_all = true;
  for (const int other : spec_.is_square() ? places_at_first() : std::vector{place}) {
    const Branch own = branch({other, false});
    if (own && can_be_regularised(spec_, *own)) return true;
    knows_all = knows_all && own;
  }
  if (!knows_all) return {};
  return false;
}

bool RadiusPlan::find(const std::vector<int>& places, bool regularised, Nodes& nodes) {
  bool has_all = true;
  for (const int place : places) {
    const BranchTask task{place, regularised};
    const std::optional<bool> wanted = regularised ? wants_regularised(place) : true;
    Branch found = branch(task);
    if (!found && wanted == false) found = std::make_shared<SampledBranch>();
    if (!found) found = records_(task);
    if (found)
      nodes[place] = known_[task] = found;
    else if (has_all = false; wanted)
      missing_.push_back(task);
  }
  return has_all;
}

std::vector<int> RadiusPlan::next_places(const Nodes& nodes, bool regularised) {
  const BranchLine line(spec_, nodes);
  std::vector<int> middles;
  for (std::size_t gap = 0; gap < line.gaps(); ++gap)
    if (!line.is_smooth(gap) && line.place(gap) + 1 < line.place(gap + 1))
      middles.push_back((line.place(gap) + line.place(gap + 1)) / 2);
  return middles.empty() ? lie_between(line, regularised) : middles;
}

std::vector<int> RadiusPlan::lie_between(const BranchLine& line, bool regularised) {
  std::vector<int> untold;
  std::map<BranchTask, Branch> between;
  for (std::size_t gap = 0; gap < line.gaps(); ++gap)
    for (int place = line.place(gap) + 1; place < line.place(gap + 1); ++place) {
      const BranchTask task{place, regularised};
      if (known_.contains(task)) continue;
      Branch branch = records_(task);
      if (!branch) branch = line.between(gap, places_[static_cast<std::size_t>(place)].radius_um);
      if (branch)
        between[task] = branch;
      else
        untold.push_back(place);
    }
  if (untold.empty()) known_.merge(between);
  return untold;
}

}  // namespace rheocyte
