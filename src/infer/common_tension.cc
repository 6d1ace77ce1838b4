#include "infer/common_tension.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numeric/quantile.h"
#include "numeric/roots.h"

namespace rheocyte {

namespace {

/// Of a normal distribution: the quantile of 95 %, and what the chi squared of one parameter exceeds in one of ten.
constexpr double normal_95 = 1.645, chi_squared_90 = normal_95 * normal_95;
/// A cell counts ever less if its misfit exceeds so many times that of the median cell, or its degrees of freedom.
constexpr double soft_limit = 6;
/// Of the tension: so closely the minimum and the ends of the interval are found.
constexpr double resolution = 1e-3;

/// The robust sum over the cells as a function of the tension. Each cell goes on from where it was.
class TensionProfile {
 public:
  /// The cells that are in the table at the tension that most of them have; where they are with a tension of their own
  /// is not asked, because it would choose among them by that.
  TensionProfile(const SeveralModuli& moduli, std::span<const SeenCell> cells) : moduli_(moduli) {
    std::vector<Free> all;
    for (const SeenCell& cell : cells) {
      const auto free = moduli.nearest(cell.shape, cell.flow, AxialTension::unknown());
      if (!free) continue;
      all.push_back({&cell, free->cell});
      if (moduli.table().at(free->cell).inside) tensions_.push_back(moduli.axial_tension_Pa(free->cell, cell.flow));
    }
    std::vector<double> misfits;
    for (const auto& [cell, start] : all) {
      const auto found = moduli.nearest(cell->shape, cell->flow, {middle(), 0}, &start);
      if (!moduli.table().at(found->cell).inside) continue;
      misfits.push_back(found->chi_squared);
      cells_.push_back({cell, found->cell});
    }
    limit_ = soft_limit * std::max(double(moduli.freedom()), quantile(misfits, 0.5));
  }

  std::size_t cells() const { return cells_.size(); }
  /// Median and standard deviation of the tensions of single cells.
  double middle() const { return quantile(tensions_, 0.5); }
  double spread() const { return central_width(tensions_) / (2 * normal_95); }

  double at(double tension_Pa) {
    double sum = 0;
    for (auto& [cell, last] : cells_) {
      const auto found = moduli_.nearest(cell->shape, cell->flow, {tension_Pa, 0}, &last);
      last = found->cell;
      sum += limit_ * std::log1p(found->chi_squared / limit_);
    }
    return sum;
  }

  double misfit(double sum) const { return sum / (double(cells()) * std::max(moduli_.freedom(), 1)); }

 private:
  struct Free {
    const SeenCell* seen;
    CellCoordinates cell;
  };

  const SeveralModuli& moduli_;
  double limit_ = soft_limit;
  std::vector<Free> cells_;
  std::vector<double> tensions_;
};

/// Of a smooth function with one minimum in [low, high]: by the golden section.
struct Minimum {
  double place, value;
};

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

}  // namespace

AxialTension CommonTension::tension() const {
  if (!is_found()) return AxialTension::unknown();
  return {value_Pa, (upper_Pa - lower_Pa) / (2 * normal_95)};
}

CommonTension common_tension(const SeveralModuli& moduli, std::span<const SeenCell> cells) {
  TensionProfile profile(moduli, cells);
  CommonTension found;
  found.cells = profile.cells();
  if (found.cells < CommonTension::min_cells) return found;
  const double middle = profile.middle(), unit = std::max(profile.spread(), 1e-2 * wall_shear_stress_Pa(cells[0].flow));
  const auto sum = [&](double tension_Pa) { return profile.at(tension_Pa); };
  const Minimum least = minimum_between(sum, middle - 2 * unit, middle + 2 * unit, resolution * 4 * unit);
  found.value_Pa = least.place;
  found.misfit = profile.misfit(least.value);
  const double level = least.value + chi_squared_90 * std::max(found.misfit, 1.0);
  const auto end = [&](double direction) {
    const auto excess = [&](double tension_Pa) { return sum(tension_Pa) - level; };
    double near = least.place, far = least.place + direction * unit / std::sqrt(double(found.cells));
    for (int doubling = 0; doubling < 8 && excess(far) < 0; ++doubling) {
      near = far;
      far = least.place + 2 * (far - least.place);
    }
    return bracketed_root(excess, near, far, resolution * unit);
  };
  found.lower_Pa = end(-1);
  found.upper_Pa = end(1);
  return found;
}

}  // namespace rheocyte
