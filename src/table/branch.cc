#include "table/branch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>

#include "numeric/hermite.h"
#include "numeric/no_value.h"
#include "numeric/roots.h"

namespace rheocyte {

namespace {

std::string reason(Status status) {
  switch (status) {
    case Status::surface_unstable: return "the surface loses its stability";
    case Status::limit_point: return "the branch turns back: softer cells elongate without limit";
    case Status::branch_ended: return "no next state was found";
    case Status::accuracy_not_reached: return "the next state is not within the accuracy on the finest mesh";
    case Status::mesh_folded: return "the mesh of the liquid folds";
    case Status::stopped: return "stopped by a signal";
    case Status::covered: return "The branch leaves the table's ranges.";
    case Status::dented: return "The dent at the rear is as deep as the table admits.";
    default: return std::string("Newton's method ended: ") + name(status);
  }
}

/// The interval of the samples, stiff to soft, in which a stiffness lies; the branch has at least two.
std::size_t interval_around(const SampledBranch& branch, double stiffness) {
  assert(stiffness <= branch.stiffness.front() && stiffness >= branch.stiffness.back());
  const auto softer = std::upper_bound(branch.stiffness.begin(), branch.stiffness.end(), stiffness, std::greater<>());
  const auto behind = std::size_t(softer - branch.stiffness.begin());
  return std::clamp<std::size_t>(behind, 1, branch.stiffness.size() - 1) - 1;
}

/// The samples around an interval, and where they are: polynomials run in the compliance, in which what elastic cells
/// do is analytic down to the undeformed one.
struct Around {
  double first;  ///< the stiffness before the interval
  std::vector<std::size_t> samples;
  std::vector<double> places;  ///< first / stiffness - 1

  Around(const SampledBranch& branch, std::size_t interval) : first(branch.stiffness[interval]) {
    const auto dented = [&](std::size_t i) {
      return is_dented(branch.at(int(i), Measure::deformation), branch.at(int(i), Measure::deformation_raw));
    };
    // Those of one kind.
    std::size_t begin = interval, end = interval + 2;
    if (dented(interval) == dented(interval + 1)) {
      while (begin > 0 && dented(begin - 1) == dented(interval)) --begin;
      while (end < branch.stiffness.size() && dented(end) == dented(interval)) ++end;
    }
    const auto place = [&](std::size_t i) { return place_of(branch.stiffness[begin + i]); };
    samples = places_around(end - begin, place, interval - begin, samples_around);
    places.reserve(samples.size());
    for (std::size_t& i : samples) {
      places.push_back(place(i));
      i += begin;
    }
  }
  double place_of(double stiffness) const { return first / stiffness - 1; }
  /// d ln(stiffness) / d(place)
  static double slope_at(double place) { return -1 / (1 + place); }

  /// The polynomial through what `value` gives of the samples, and `slope` with ln(stiffness).
  template <class Value, class Slope>
  auto at(double stiffness, const Value& value, const Slope& slope) const {
    const LagrangeWeights weights = hermite_weights(places, place_of(stiffness));
    const auto weight = [&](std::size_t k) { return weights.slope[k] * slope_at(places[k]); };
    auto sum = (weights.value[0] * value(samples[0]) + weight(0) * slope(samples[0])).eval();
    for (std::size_t k = 1; k < samples.size(); ++k)
      sum += weights.value[k] * value(samples[k]) + weight(k) * slope(samples[k]);
    return sum;
  }
};

/// One measure between two samples. Deformations by their logarithm, because they go over many decades, and those of
/// round cells over the square of the compliance, to which they are proportional at first.
class Piece {
 public:
  Piece(const SampledBranch& branch, const Around& around, Measure measure) {
    std::array<double, samples_around> values{}, slopes{};
    const std::size_t count = around.samples.size();
    logarithmic_ = measure == Measure::deformation || measure == Measure::deformation_raw;
    for (std::size_t k = 0; k < count; ++k) {
      values[k] = branch.value(Eigen::Index(around.samples[k]), int(measure));
      slopes[k] = branch.slope(Eigen::Index(around.samples[k]), int(measure)) * Around::slope_at(around.places[k]);
      logarithmic_ = logarithmic_ && values[k] > 0;
    }
    power_ = logarithmic_ && branch.axial_ratio == 0 ? 2 : 0;
    for (std::size_t k = 0; logarithmic_ && k < count; ++k) {
      const double compliance = 1 + around.places[k];
      slopes[k] = slopes[k] / values[k] - power_ / compliance;
      values[k] = std::log(values[k]) - power_ * std::log(compliance);
    }
    polynomial_.emplace(around.places, std::span(values).first(count), std::span(slopes).first(count));
  }

  double at(double place) const {
    const double value = inner(place).value;
    return logarithmic_ ? std::exp(value) : value;
  }

  /// The place from 0 to `last`, the ends of the interval, where the measure has a value that lies between theirs.
  double place_of(double wanted, double last) const {
    const double target = logarithmic_ ? std::log(wanted) : wanted;
    const double first = inner(0).value, rise = inner(last).value - first;
    const double fraction = rise == 0 ? 0 : std::clamp((target - first) / rise, 0.0, 1.0);
    const auto miss = [&](double place) {
      const auto [value, slope] = inner(place);
      return ValueAndSlope{value - target, slope};
    };
    return bracketed_newton(miss, 0, last, fraction * last, rise > 0, 1e-15 * last);
  }

 private:
  /// Of the logarithm, where it is taken.
  ValueAndSlope inner(double place) const {
    const auto [value, slope] = polynomial_->at(place);
    if (power_ == 0) return {value, slope};
    return {value + power_ * std::log1p(place), slope + power_ / (1 + place)};
  }

  std::optional<HermitePolynomial> polynomial_;
  bool logarithmic_ = false;
  double power_ = 0;  ///< of the compliance
};

}  // namespace

BranchEnd end_of(Status status) { return {status, reason(status)}; }

double interpolate(const SampledBranch& branch, Measure measure, double stiffness) {
  if (branch.samples() == 1) return branch.at(0, measure);
  const Around around(branch, interval_around(branch, stiffness));
  return Piece(branch, around, measure).at(around.place_of(stiffness));
}

Eigen::VectorXd interpolate(const SampledBranch& branch, double stiffness) {
  if (branch.samples() == 1) return branch.value.row(0);
  const Around around(branch, interval_around(branch, stiffness));
  Eigen::VectorXd values = around.at(
      stiffness, [&](std::size_t i) { return branch.value.row(Eigen::Index(i)).transpose(); },
      [&](std::size_t i) { return branch.slope.row(Eigen::Index(i)).transpose(); });
  for (const Measure m : {Measure::deformation, Measure::deformation_raw})
    values(int(m)) = Piece(branch, around, m).at(around.place_of(stiffness));
  return values;
}

Eigen::MatrixX2d interpolate_contour(const SampledBranch& branch, double stiffness) {
  if (branch.samples() == 1) return branch.contour.front();
  return Around(branch, interval_around(branch, stiffness))
      .at(
          stiffness, [&](std::size_t i) -> const auto& { return branch.contour[i]; },
          [&](std::size_t i) -> const auto& { return branch.contour_slope[i]; });
}

double stiffness_at(const SampledBranch& branch, Measure measure, double value) {
  if (!std::isfinite(value)) return no_value;
  for (int i = 0; i < branch.samples(); ++i) {
    const double here = branch.at(i, measure);
    if (here == value) return branch.stiffness[std::size_t(i)];
    if (i + 1 == branch.samples()) break;
    const double next = branch.at(i + 1, measure);
    if ((here - value) * (next - value) >= 0) continue;
    const double stiff = branch.stiffness[std::size_t(i)], soft = branch.stiffness[std::size_t(i) + 1];
    const Around around(branch, std::size_t(i));
    const double place = Piece(branch, around, measure).place_of(value, around.place_of(soft));
    return std::clamp(stiff / (1 + place), soft, stiff);
  }
  return no_value;
}

}  // namespace rheocyte
