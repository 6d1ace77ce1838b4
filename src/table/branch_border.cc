#include "table/branch_border.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rheocyte {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int reach = 2;  // columns over which the border is smoothed
constexpr int points_per_column = 8;

/// Where a branch ends.
struct End {
  LogBranch::Point point;
  OutOfTable beyond;
};

End end_of(const LogBranch& branch, double greatest) {
  const double s = branch.crossing([&](const LogBranch::Point& p) { return p.log_deformation - greatest; });
  if (std::isfinite(s)) return {{branch.at(s).log_area, greatest}, OutOfTable::too_soft};
  const BranchEnd& why = branch.branch().end;
  // The last state meets the greatest deformation within some per cent in a square channel.
  if (why.status == Status::covered) return {branch.last(), OutOfTable::too_soft};
  return {branch.last(), why.is_physical() ? OutOfTable::unstable : OutOfTable::unresolved};
}

/// Branches of large cells leave the table by their area, all of them at about the same one and at any deformation:
/// where others reach the greatest deformation at areas of no column, these bound nothing.
void leave_out_exits_by_area(std::vector<End>& ends, double greatest, double last_column) {
  const auto bounds = [&](const End& end) {
    return end.point.log_deformation == greatest && end.point.log_area >= last_column;
  };
  if (std::ranges::none_of(ends, bounds)) return;
  std::erase_if(ends, [&](const End& end) {
    return end.beyond == OutOfTable::too_soft && end.point.log_deformation < greatest &&
           end.point.log_area > last_column;
  });
}

// Without those that were not followed to their end: one to three of them between two that were.
std::vector<End> ends_of(std::span<const LogBranch> branches, double greatest, double last_column) {
  constexpr std::size_t max_gap = 3;
  std::vector<End> kept, gap;
  for (const auto& branch : branches) {
    const End end = end_of(branch, greatest);
    if (end.beyond == OutOfTable::unresolved) {
      gap.push_back(end);
      continue;
    }
    if (kept.empty() || gap.size() > max_gap) kept.insert(kept.end(), gap.begin(), gap.end());
    gap.clear();
    kept.push_back(end);
  }
  kept.insert(kept.end(), gap.begin(), gap.end());
  leave_out_exits_by_area(kept, greatest, last_column);
  std::ranges::stable_sort(kept, {}, [](const End& end) { return end.point.log_area; });
  return kept;
}

/// The polygon through the ends. Left of the first one the smallest cells, right of the last one the largest ones bound
/// the states.
class EndPolygon {
 public:
  EndPolygon(std::span<const LogBranch> branches, double greatest, double last_column)
      : ends_(ends_of(branches, greatest, last_column)), smallest_(branches.front()), largest_(branches.back()) {}

  double at(double log_area) const {
    if (ends_.empty() || log_area > ends_.back().point.log_area) return beyond_the_last(log_area);
    if (log_area < ends_.front().point.log_area) return on_the_smallest(log_area);
    const auto above = std::ranges::upper_bound(ends_, log_area, {}, [](const End& e) { return e.point.log_area; });
    if (above == ends_.end()) return ends_.back().point.log_deformation;
    const auto &a = (above - 1)->point, &b = above->point;
    const double fraction = (log_area - a.log_area) / (b.log_area - a.log_area);
    return a.log_deformation + fraction * (b.log_deformation - a.log_deformation);
  }

  bool is_between_ends(double log_area) const {
    return !ends_.empty() && log_area >= ends_.front().point.log_area && log_area <= ends_.back().point.log_area;
  }

  OutOfTable beyond(double log_area) const {
    const End* nearest = &ends_.front();
    for (const End& end : ends_)
      if (std::abs(end.point.log_area - log_area) < std::abs(nearest->point.log_area - log_area)) nearest = &end;
    return nearest->beyond;
  }

 private:
  double on_the_smallest(double log_area) const {
    const double s = smallest_.crossing([&](const LogBranch::Point& p) { return p.log_area - log_area; });
    return std::isfinite(s) ? smallest_.at(s).log_deformation : -infinity;
  }
  // The largest cells have all states up to their end, as long as their stiffest one is larger still.
  double beyond_the_last(double log_area) const {
    return log_area <= largest_.first().log_area ? largest_.last().log_deformation : -infinity;
  }

  std::vector<End> ends_;
  LogBranch smallest_, largest_;
};

}  // namespace

LogBranch::Point LogBranch::at(double log_stiffness) const {
  const double stiffness = std::clamp(std::exp(log_stiffness), branch_->stiffness.back(), branch_->stiffness.front());
  return {std::log(interpolate(*branch_, Measure::area_um2, stiffness)),
          std::log(interpolate(*branch_, Measure::deformation, stiffness))};
}

double LogBranch::stiffest() const { return std::log(branch_->stiffness.front()); }
double LogBranch::softest() const { return std::log(branch_->stiffness.back()); }

Border upper_border(std::span<const LogBranch> branches, const TableSpec& spec, const Columns& columns) {
  const double greatest = std::log(spec.max_deformation);
  const EndPolygon polygon(branches, greatest, columns.at(columns.count - 1));
  // The least height within the reach, then the mean of these within the reach: never above the polygon, and smooth.
  const int margin = 2 * reach * points_per_column, count = (columns.count - 1) * points_per_column + 1 + 2 * margin;
  std::vector<double> line(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double column = static_cast<double>(i - margin) / points_per_column;
    const double inner = std::clamp(column, 0.0, columns.count - 1.0);
    const double log_area = columns.at(polygon.is_between_ends(columns.at(column)) ? column : inner);
    line[static_cast<std::size_t>(i)] = std::min(polygon.at(log_area), greatest);
  }
  const auto window = [&](const std::vector<double>& values, int middle) {
    return std::span(values).subspan(static_cast<std::size_t>(middle - reach * points_per_column),
                                     2 * reach * points_per_column + 1);
  };
  std::vector<double> least(line.size(), -infinity);
  for (int i = margin / 2; i < count - margin / 2; ++i)
    least[static_cast<std::size_t>(i)] = std::ranges::min(window(line, i));
  Border border;
  for (int c = 0; c < columns.count; ++c) {
    double sum = 0, weights = 0;
    const auto near = window(least, margin + c * points_per_column);
    for (std::size_t k = 0; k < near.size(); ++k) {
      const double distance = 2.0 * static_cast<double>(k) / static_cast<double>(near.size() - 1) - 1;
      const double weight = 1 + std::cos(std::numbers::pi * distance);
      sum += weight * near[k];
      weights += weight;
    }
    border.height.push_back(sum / weights);
    const bool is_highest = border.height.back() > greatest - 1e-9;
    border.beyond.push_back(is_highest ? OutOfTable::too_soft : polygon.beyond(columns.at(c)));
  }
  return border;
}

}  // namespace rheocyte
