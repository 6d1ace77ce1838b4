#include "infer/common_tension.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr double normal_95 = 1.645;  ///< quantile of a normal distribution
/// A cell counts ever less if its misfit exceeds so many times that of the median cell, or its degrees of freedom.
constexpr double soft_limit = 6;
/// Of the range that is searched: so closely the minimum is found.
constexpr double resolution = 1e-3;
/// Of the spread of the tensions of single cells: over so much the losses of the cells are differentiated.
constexpr double difference = 0.2;

/// Relative standard error of what all cells of a recording have in common: tensions of virtual recordings in pixels of
/// 0.34 um are off by 2.5 % in the mean square (docs/verification.md, sec. 7).
constexpr double common_error = 0.025;
/// Fewer groups tell no scatter.
constexpr std::size_t fewest_groups = 3;

/// The robust sum over the cells as a function of the tension. Each cell goes on from where it was.
class TensionProfile {
 public:
  /// The cells that are in the table at the tension that most of them have; where they are with a tension of their own
  /// is not asked, because it would choose among them by that.
  TensionProfile(const BulkCortexFit& moduli, std::span<const SeenCell> cells, const std::function<void()>& goes_on)
      : moduli_(moduli), goes_on_(goes_on) {
    std::vector<Free> all;
    for (const SeenCell& cell : cells) {
      goes_on();
      const auto free = moduli.nearest(cell.shape, cell.flow, AxialTension::unknown());
      if (!free) continue;
      all.push_back({&cell, free->cell});
      if (moduli.table().at(free->cell).inside) tensions_.push_back(moduli.axial_tension_Pa(free->cell, cell.flow));
    }
    std::vector<double> misfits;
    for (const auto& [cell, start] : all) {
      goes_on();
      const auto found = moduli.nearest(cell->shape, cell->flow, {middle(), 0}, &start);
      if (!moduli.table().at(found->cell).inside) continue;
      misfits.push_back(found->chi_squared);
      cells_.push_back({cell, found->cell});
    }
    limit_ = soft_limit * std::max(double(moduli.freedom()), quantile(misfits, 0.5));
  }

  std::size_t groups() const { return cells_.size(); }
  std::size_t cells() const {
    std::size_t sum = 0;
    for (const Free& group : cells_) sum += group.seen->cells;
    return sum;
  }
  /// Median and standard deviation of the tensions of single cells.
  double middle() const { return quantile(tensions_, 0.5); }
  double spread() const { return central_width(tensions_) / (2 * normal_95); }

  /// Each cell's fraction of the sum.
  std::vector<double> losses(double tension_Pa) {
    std::vector<double> losses;
    for (auto& [cell, last] : cells_) {
      goes_on_();
      const auto found = moduli_.nearest(cell->shape, cell->flow, {tension_Pa, 0}, &last);
      last = found->cell;
      losses.push_back(limit_ * std::log1p(found->chi_squared / limit_));
    }
    return losses;
  }

 private:
  struct Free {
    const SeenCell* seen;
    CellCoordinates cell;
  };

  const BulkCortexFit& moduli_;
  const std::function<void()>& goes_on_;
  double limit_ = soft_limit;
  std::vector<Free> cells_;
  std::vector<double> tensions_;
};

struct Minimum {
  double place, value;
};

/// Of a function with one minimum in [low, high]: by the golden section.
template <class Function>
Minimum minimum_between(const Function& f, double low, double high, double tolerance) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = high - golden * (high - low), b = low + golden * (high - low), fa = f(a), fb = f(b);
  while (high - low > tolerance) {
    if (fa < fb) {
      high = b, b = a, fb = fa;
      a = high - golden * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb;
      b = low + golden * (high - low), fb = f(b);
    }
  }
  return fa < fb ? Minimum{a, fa} : Minimum{b, fb};
}

/// Quantile of 95 % of Student's t (Abramowitz and Stegun, 26.7.5): at two degrees of freedom 3 % too small, at more
/// less.
double student_95(double freedom) {
  const double z = normal_95, z2 = z * z;
  return z + z *
                 ((z2 + 1) / 4 + ((5 * z2 + 16) * z2 + 3) / (96 * freedom) +
                  (((3 * z2 + 19) * z2 + 17) * z2 - 15) / (384 * freedom * freedom)) /
                 freedom;
}

double sum_of(const std::vector<double>& losses) { return std::accumulate(losses.begin(), losses.end(), 0.0); }

/// Of the place where a sum of the cells' losses is least: by the scatter of their slopes there over the curvature of
/// the sum (Huber 1967). It holds whatever else the cells differ in, where a rise of chi squared by so much holds only
/// for cells of the model.
double error_of_minimum(TensionProfile& profile, double place, double sum, double step) {
  const std::vector<double> below = profile.losses(place - step), above = profile.losses(place + step);
  const double curvature = (sum_of(below) - 2 * sum + sum_of(above)) / (step * step);
  double squares = 0;
  for (std::size_t i = 0; i < below.size(); ++i) squares += std::pow((above[i] - below[i]) / (2 * step), 2);
  const double n = double(below.size());
  return curvature > 0 ? std::sqrt(squares * n / (n - 1)) / curvature : HUGE_VAL;
}

}  // namespace

AxialTension CommonTension::tension() const {
  if (!is_found()) return AxialTension::unknown();
  return {value_Pa, (upper_Pa - lower_Pa) / (2 * normal_95)};
}

void CommonTension::widen(double error_Pa) {
  const double half_width_Pa = std::hypot((upper_Pa - lower_Pa) / 2, normal_95 * error_Pa);
  lower_Pa = value_Pa - half_width_Pa;
  upper_Pa = value_Pa + half_width_Pa;
}

CommonTension common_tension(const BulkCortexFit& moduli, std::span<const SeenCell> cells,
                             const std::function<void()>& goes_on) {
  TensionProfile profile(moduli, cells, goes_on);
  CommonTension found;
  found.cells = profile.cells();
  if (found.cells < CommonTension::min_cells || profile.groups() < fewest_groups) return found;
  const double middle = profile.middle(), unit = std::max(profile.spread(), 1e-2 * wall_shear_stress_Pa(cells[0].flow));
  const auto [value_Pa, sum] = minimum_between([&](double tension_Pa) { return sum_of(profile.losses(tension_Pa)); },
                                               middle - 2 * unit, middle + 2 * unit, resolution * 4 * unit);
  const double n = double(profile.groups());
  const double error_Pa = error_of_minimum(profile, value_Pa, sum, difference * unit);
  const double of_scatter_Pa = error_Pa * student_95(n - 1);
  found.value_Pa = value_Pa;
  found.misfit = sum / (n * std::max(moduli.freedom(), 1));
  // What the model leaves of the shapes is no scatter, but it is an error of the tension.
  const double common_Pa = common_error * std::sqrt(std::max(found.misfit, 1.0)) * value_Pa;
  const double half_width_Pa = std::hypot(of_scatter_Pa, normal_95 * common_Pa);
  found.lower_Pa = value_Pa - half_width_Pa;
  found.upper_Pa = value_Pa + half_width_Pa;
  return found;
}

}  // namespace rheocyte
