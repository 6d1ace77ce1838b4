#include "fem/nested_order.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <tuple>

namespace rheocyte {
namespace {

/// Unknowns of the same elements stay together.
struct Group {
  std::vector<int> elements;  ///< ascending
  std::vector<int> unknowns;
  int pressure_of = -1;  ///< element whose constant pressure this is
};

/// What a subdomain looks like from outside.
struct Region {
  std::array<int, 2> parts{-1, -1};
  std::vector<bool> elements;
  std::vector<int> groups;      ///< that remain, ascending
  std::vector<int> pressures;   ///< elements whose pressures remain: one per connected part of a medium
  std::vector<int> eliminated;  ///< groups
};

/// Operations and sizes of joining two regions.
struct Cost {
  double flops = 0, remaining = 0, before = 0;
};

class Joining {
 public:
  Joining(int unknowns, const std::vector<CoupledUnknowns>& elements) : elements_(elements) {
    std::vector<std::vector<int>> of_unknown(unknowns);
    for (int e = 0; e < int(elements.size()); ++e) {
      for (const int i : elements[e].unknowns) of_unknown[i].push_back(e);
    }
    std::vector<int> pressure_of(unknowns, -1);
    for (int e = 0; e < int(elements.size()); ++e) {
      if (elements[e].pressure >= 0) pressure_of[elements[e].pressure] = e;
    }
    std::map<std::pair<std::vector<int>, int>, int> known;
    for (int i = 0; i < unknowns; ++i) {
      if (of_unknown[i].empty()) continue;
      const auto [at, fresh] = known.try_emplace({of_unknown[i], pressure_of[i]}, int(groups_.size()));
      if (fresh) groups_.push_back({of_unknown[i], {}, pressure_of[i]});
      groups_[at->second].unknowns.push_back(i);
    }
    for (int e = 0; e < int(elements.size()); ++e) {
      Region& region = start_.emplace_back();
      region.elements.assign(elements.size(), false);
      region.elements[e] = true;
      if (elements[e].pressure >= 0) region.pressures.push_back(e);
      for (int g = 0; g < int(groups_.size()); ++g) {
        if (!std::binary_search(groups_[g].elements.begin(), groups_[g].elements.end(), e)) continue;
        (stays(g, region) ? region.groups : region.eliminated).push_back(g);
      }
    }
  }

  /// Joins the neighbours of the least rank again and again.
  std::vector<Region> join(const std::function<double(const Cost&)>& rank) const {
    using Pair = std::tuple<double, int, int>;  // rank, and the regions in ascending order
    std::vector<Region> regions = start_;
    std::vector<int> left;  // regions that are not joined yet
    std::vector<Pair> neighbours;
    const auto add = [&](int b) {
      for (const int a : left) {
        if (are_neighbours(regions[a], regions[b])) neighbours.emplace_back(rank(cost(regions[a], regions[b])), a, b);
      }
      left.push_back(b);
    };
    const int n = int(elements_.size());
    for (int region = 0; region < n; ++region) add(region);
    for (int joined = n; joined < 2 * n - 1; ++joined) {
      if (neighbours.empty()) return {};
      const auto [least, first, second] = *std::ranges::min_element(neighbours);
      regions.push_back(together(regions[first], regions[second], {first, second}));
      const auto is_joined = [first, second](int a) { return a == first || a == second; };
      std::erase_if(left, is_joined);
      std::erase_if(neighbours, [&](const Pair& p) { return is_joined(std::get<1>(p)) || is_joined(std::get<2>(p)); });
      add(joined);
    }
    return regions;
  }

  double flops(const std::vector<Region>& regions) const {
    if (regions.empty()) return forbidden;
    double sum = 0;
    for (const Region& region : regions) sum += elimination_flops(size(region.eliminated), size(region.groups));
    return sum;
  }

  std::vector<Subdomain> subdomains(const std::vector<Region>& regions) const {
    std::vector<Subdomain> result;
    for (const Region& region : regions) {
      Subdomain& subdomain = result.emplace_back();
      subdomain.parts = region.parts;
      for (const auto& [from, to] :
           {std::pair{&region.eliminated, &subdomain.eliminated}, std::pair{&region.groups, &subdomain.remaining}}) {
        for (const int g : *from) to->insert(to->end(), groups_[g].unknowns.begin(), groups_[g].unknowns.end());
      }
    }
    return result;
  }

 private:
  static constexpr double forbidden = std::numeric_limits<double>::infinity();

  double size(const std::vector<int>& groups) const {
    double sum = 0;
    for (const int g : groups) sum += double(groups_[g].unknowns.size());
    return sum;
  }

  bool is_whole(const Region& region) const {
    return std::all_of(region.elements.begin(), region.elements.end(), [](bool inside) { return inside; });
  }

  /// Whether a group of the region is known outside, or is the pressure that stays.
  bool stays(int g, const Region& region) const {
    const Group& group = groups_[g];
    if (is_whole(region)) return false;
    if (group.pressure_of >= 0)
      return std::find(region.pressures.begin(), region.pressures.end(), group.pressure_of) != region.pressures.end();
    return !std::all_of(group.elements.begin(), group.elements.end(), [&](int e) { return region.elements[e]; });
  }

  bool are_neighbours(const Region& a, const Region& b) const {
    for (int e = 0; e < int(elements_.size()); ++e) {
      if (!a.elements[e]) continue;
      for (const int f : elements_[e].neighbours) {
        if (b.elements[f]) return true;
      }
    }
    return false;
  }

  Cost cost(const Region& a, const Region& b) const {
    const Region both = union_of(a, b);
    double eliminated = 0, remaining = 0;
    for (const int g : both.groups) {
      const Group& group = groups_[g];
      const bool inside = group.pressure_of < 0 && std::all_of(group.elements.begin(), group.elements.end(),
                                                               [&](int e) { return both.elements[e]; });
      (inside ? eliminated : remaining) += double(group.unknowns.size());
    }
    return {elimination_flops(eliminated, remaining), remaining, std::max(size(a.groups), size(b.groups))};
  }

  static Region union_of(const Region& a, const Region& b) {
    Region both;
    both.elements = a.elements;
    for (std::size_t e = 0; e < both.elements.size(); ++e) both.elements[e] = a.elements[e] || b.elements[e];
    std::set_union(a.groups.begin(), a.groups.end(), b.groups.begin(), b.groups.end(), std::back_inserter(both.groups));
    return both;
  }

  Region together(const Region& a, const Region& b, std::array<int, 2> parts) const {
    Region both = union_of(a, b);
    both.parts = parts;
    both.pressures = one_of_each_part(both, a.pressures, b.pressures);
    std::vector<int> remaining;
    for (const int g : both.groups) (stays(g, both) ? remaining : both.eliminated).push_back(g);
    both.groups = std::move(remaining);
    return both;
  }

  /// Of the pressures that remain of two regions those that still have to: one where parts of a medium have met.
  std::vector<int> one_of_each_part(const Region& region, const std::vector<int>& a, const std::vector<int>& b) const {
    std::vector<int> part(elements_.size(), -1), result;
    for (const auto* pressures : {&a, &b}) {
      for (const int e : *pressures) {
        if (part[e] >= 0) continue;
        result.push_back(e);
        std::vector<int> open{e};
        part[e] = e;
        while (!open.empty()) {
          const int f = open.back();
          open.pop_back();
          for (const int next : elements_[f].neighbours) {
            if (!region.elements[next] || part[next] >= 0 || elements_[next].medium != elements_[e].medium) continue;
            part[next] = e;
            open.push_back(next);
          }
        }
      }
    }
    return result;
  }

  const std::vector<CoupledUnknowns>& elements_;
  std::vector<Group> groups_;
  std::vector<Region> start_;
};

}  // namespace

std::vector<Subdomain> nested_order(int unknowns, const std::vector<CoupledUnknowns>& elements) {
  const Joining joining(unknowns, elements);
  std::vector<Region> best;
  const std::function<double(const Cost&)> rankings[] = {
      [](const Cost& c) { return c.flops; },
      [](const Cost& c) { return c.remaining; },
      [](const Cost& c) { return c.remaining - c.before; },
      [](const Cost& c) { return c.remaining - 0.5 * c.before; },
      [](const Cost& c) { return c.remaining * c.remaining - c.before * c.before; },
  };
  for (const auto& rank : rankings) {
    std::vector<Region> regions = joining.join(rank);
    if (best.empty() || joining.flops(regions) < joining.flops(best)) best = std::move(regions);
  }
  return joining.subdomains(best);
}

}  // namespace rheocyte
