#include "table/branch.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numeric/hermite.h"
#include "numeric/no_value.h"
#include "numeric/roots.h"

namespace rheocyte {

namespace {

std::string reason(Status status) {
  switch (status) {
    case Status::surface_unstable: return "the surface loses stability against short wrinkles";
    case Status::branch_ended: return "the branch turns back: softer cells are drawn out without limit";
    case Status::accuracy_not_reached: return "the next state is not within the accuracy on the finest mesh";
    case Status::mesh_folded: return "the mesh of the liquid folds";
    case Status::stopped: return "stopped by a signal";
    case Status::covered: return "The branch leaves the table's ranges.";
    case Status::dented: return "The dent at the rear is as deep as the table admits.";
    default: return std::string("Newton's method ended: ") + name(status);
  }
}

// The place of a stiffness: the interval behind a sample, and how far in it, 0 .. 1 in ln(stiffness).
struct Place {
  int sample = 0;
  double fraction = 0, width = 0;  ///< width: of the interval in ln(stiffness), negative
};

Place place_of(const SampledBranch& branch, double stiffness) {
  assert(!branch.empty() && stiffness <= branch.stiffness.front() && stiffness >= branch.stiffness.back());
  if (branch.samples() == 1) return {};
  const auto softer = std::upper_bound(branch.stiffness.begin(), branch.stiffness.end(), stiffness, std::greater<>());
  const int sample = std::clamp(int(softer - branch.stiffness.begin()) - 1, 0, branch.samples() - 2);
  const double stiff = branch.stiffness[std::size_t(sample)],
               width = std::log(branch.stiffness[std::size_t(sample) + 1] / stiff);
  return {sample, std::log(stiffness / stiff) / width, width};
}

// One measure between two samples; deformations by their logarithm, because d ~ stiffness^-2 over many decades.
class Piece {
 public:
  Piece(const SampledBranch& branch, int sample, double width, Measure measure) {
    const auto column = Eigen::Index(int(measure));
    for (const int end : {0, 1}) {
      value_[end] = branch.value(sample + end, column);
      slope_[end] = branch.slope(sample + end, column) * width;
    }
    const bool is_deformation = measure == Measure::deformation || measure == Measure::deformation_raw;
    logarithmic_ = is_deformation && value_[0] > 0 && value_[1] > 0;
    if (!logarithmic_) return;
    for (const int end : {0, 1}) {
      slope_[end] /= value_[end];
      value_[end] = std::log(value_[end]);
    }
  }

  double inner(double value) const { return logarithmic_ ? std::log(value) : value; }
  double at(double t) const { return logarithmic_ ? std::exp(inner_at(t)) : inner_at(t); }
  double inner_at(double t) const { return hermite(t)(value_[0], value_[1], slope_[0], slope_[1]); }

  // The place between 0 and 1 where the measure has a value that lies between those of the ends.
  double place_of(double wanted) const {
    const double target = inner(wanted), rise = value_[1] - value_[0];
    const double start = rise == 0 ? 0 : std::clamp((target - value_[0]) / rise, 0.0, 1.0);
    const auto miss = [&](double t) {
      return ValueAndSlope{inner_at(t) - target, hermite_slope(t)(value_[0], value_[1], slope_[0], slope_[1])};
    };
    return bracketed_newton(miss, 0, 1, start, rise > 0, 1e-15);
  }

 private:
  std::array<double, 2> value_{}, slope_{};
  bool logarithmic_ = false;
};

double piece_value(const SampledBranch& branch, const Place& place, Measure measure) {
  if (branch.samples() == 1) return branch.at(0, measure);
  return Piece(branch, place.sample, place.width, measure).at(place.fraction);
}

}  // namespace

BranchEnd end_of(Status status) { return {status, reason(status)}; }

double interpolate(const SampledBranch& branch, Measure measure, double stiffness) {
  return piece_value(branch, place_of(branch, stiffness), measure);
}

Eigen::VectorXd interpolate(const SampledBranch& branch, double stiffness) {
  const Place place = place_of(branch, stiffness);
  Eigen::VectorXd values(measure_count);
  for (int m = 0; m < measure_count; ++m) values(m) = piece_value(branch, place, Measure(m));
  return values;
}

Eigen::MatrixX2d interpolate_contour(const SampledBranch& branch, double stiffness) {
  const Place place = place_of(branch, stiffness);
  const auto first = std::size_t(place.sample);
  if (branch.samples() == 1) return branch.contour.front();
  const auto w = hermite(place.fraction);
  return w.first * branch.contour[first] + w.last * branch.contour[first + 1] +
         place.width * (w.first_slope * branch.contour_slope[first] + w.last_slope * branch.contour_slope[first + 1]);
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
    const double width = std::log(soft / stiff);
    const double fraction = Piece(branch, i, width, measure).place_of(value);
    return std::clamp(stiff * std::exp(fraction * width), soft, stiff);
  }
  return no_value;
}

}  // namespace rheocyte
