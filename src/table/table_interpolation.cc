#include "table/table_interpolation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "numeric/lagrange.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

constexpr int max_radius_stencil = 6;

StiffnessAnswer out_of_table(OutOfTable reason) { return {no_value, no_value, false, reason}; }

}  // namespace

std::string_view name_of(OutOfTable reason) {
  switch (reason) {
    case OutOfTable::none: return "";
    case OutOfTable::invalid: return "invalid";
    case OutOfTable::too_small: return "too-small";
    case OutOfTable::too_large: return "too-large";
    case OutOfTable::too_stiff: return "too-stiff";
    case OutOfTable::too_soft: return "too-soft";
    case OutOfTable::unstable: return "unstable";
    case OutOfTable::unresolved: return "unresolved";
  }
  return "";
}

// One question: the size, by area or volume, and the deformation.
class TableInterpolation::Query {
 public:
  Query(const TableInterpolation& table, Abscissa abscissa, double size, double deformation)
      : table_(table), abscissa_(abscissa), size_(size), deformation_(deformation) {}

  StiffnessAnswer answer() const {
    if (const auto reason = outside(); reason != OutOfTable::none) return out_of_table(reason);
    // The circle or sphere of this size is a good guess of the radius.
    const auto guess = std::ranges::upper_bound(table_.radii_, sphere_radius(), {}, &RadiusBranches::radius_um);
    const int last = count() - 1;
    int below = std::clamp(int(guess - table_.radii_.begin()) - 1, 0, last - 1);
    while (below > 0 && size_near(below) > size_) --below;
    while (below < last - 1 && size_near(below + 1) < size_) ++below;
    if (size_near(below) > size_) return out_of_table(OutOfTable::too_small);
    if (size_near(below + 1) < size_) return out_of_table(OutOfTable::too_large);
    const auto first = node(below), second = node(below + 1);
    if (!first) return out_of_table(missing(below));
    if (!second) return out_of_table(missing(below + 1));
    return between(below, *first, *second);
  }

 private:
  struct Node {
    BranchPoint state;
    double x, y;  ///< ln(size / requested size), ln(stiffness)
  };

  int count() const { return int(table_.radii_.size()); }
  const RadiusBranches& radius(int i) const { return table_.radii_[std::size_t(i)]; }
  Measure size_measure() const { return abscissa_ == Abscissa::area ? Measure::area_um2 : Measure::volume_um3; }

  double sphere_radius() const {
    return abscissa_ == Abscissa::area ? std::sqrt(size_ / std::numbers::pi)
                                       : std::cbrt(0.75 * size_ / std::numbers::pi);
  }

  OutOfTable outside() const {
    const TableSpec& spec = table_.spec_;
    if (!(size_ > 0 && deformation_ > 0 && std::isfinite(size_) && std::isfinite(deformation_)))
      return OutOfTable::invalid;
    if (count() < 2) return OutOfTable::unresolved;
    if (abscissa_ == Abscissa::area && size_ < spec.min_area_um2) return OutOfTable::too_small;
    if (abscissa_ == Abscissa::area && size_ > spec.max_area_um2) return OutOfTable::too_large;
    if (deformation_ < spec.min_deformation) return OutOfTable::too_stiff;
    if (deformation_ > spec.max_deformation) return OutOfTable::too_soft;
    return OutOfTable::none;
  }

  std::optional<Node> node(int i) const {
    const auto state = radius(i).at_deformation(deformation_);
    if (!state) return {};
    return Node{*state, std::log(state->measure(size_measure()) / size_), std::log(state->stiffness)};
  }

  // Of the state with the requested deformation, or of the nearest one that there is.
  double size_near(int i) const {
    if (const auto state = radius(i).at_deformation(deformation_)) return state->measure(size_measure());
    const auto softest = radius(i).softest(), stiffest = radius(i).stiffest();
    return (deformation_ > softest.measure(Measure::deformation) ? softest : stiffest).measure(size_measure());
  }

  OutOfTable missing(int i) const {
    const auto* own = radius(i).bare();
    const bool is_beyond = own && deformation_ > own->at(own->samples() - 1, Measure::deformation);
    return is_beyond && own->end.is_physical() ? OutOfTable::unstable : OutOfTable::unresolved;
  }

  // Neighbours of the two nodes, as many on both sides as there are; beside two states of one kind only of that kind,
  // because bending changes the states a little.
  std::vector<Node> stencil(int below, const Node& first, const Node& second) const {
    std::vector<Node> nodes{first, second};
    const bool mixed = first.state.regularised != second.state.regularised;
    int low = below - 1, high = below + 2;
    const auto take = [&](int i, bool in_front) {
      const auto next = i >= 0 && i < count() ? node(i) : std::nullopt;
      if (!next || (!mixed && next->state.regularised != first.state.regularised)) return false;
      nodes.insert(in_front ? nodes.begin() : nodes.end(), *next);
      return true;
    };
    for (bool down = true, up = true; (down || up) && int(nodes.size()) < max_radius_stencil;) {
      down = down && take(low--, true);
      if (int(nodes.size()) < max_radius_stencil) up = up && take(high++, false);
    }
    return nodes;
  }

  StiffnessAnswer between(int below, const Node& first, const Node& second) const {
    const auto nodes = stencil(below, first, second);
    const auto best = lagrange_estimate(std::span<const Node>(nodes), 0, &Node::x, &Node::y);  // at the requested size
    const auto [low, high] = std::minmax(first.y, second.y);
    const double value = std::clamp(best.value, low, high);
    const double states = std::max(stiffness_error(first.state), stiffness_error(second.state));
    return {std::exp(value), states + std::abs(value - best.value + best.change),
            first.state.regularised || second.state.regularised, OutOfTable::none};
  }

  const TableInterpolation& table_;
  Abscissa abscissa_;
  double size_, deformation_;
};

TableInterpolation::TableInterpolation(const TableSpec& spec, std::span<const SampledBranch> branches)
    : spec_(spec), radii_(by_radius(branches)) {
  if (spec.wants_regularised()) return;
  std::erase_if(radii_, [](const RadiusBranches& radius) { return !radius.bare(); });
  for (auto& radius : radii_) radius = RadiusBranches(*radius.bare());
}

StiffnessAnswer TableInterpolation::by_area(double area_um2, double deformation) const {
  return Query(*this, Abscissa::area, area_um2, deformation).answer();
}

StiffnessAnswer TableInterpolation::by_volume(double volume_um3, double deformation) const {
  return Query(*this, Abscissa::volume, volume_um3, deformation).answer();
}

}  // namespace rheocyte
