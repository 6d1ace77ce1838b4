#include "synth/seen_outline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shape/outline_shape.h"
#include "synth/outline.h"

namespace rheocyte {

namespace {

/// Enough for the modes; the polygon's area is then a ten thousandth too small.
constexpr int coarse_points = 240;

/// The sum of modes whose hull is looked for. Where a hull bridges a dent, the modes of the hull are others than those
/// of the outline, and most of those that tables do not hold come from there: they are taken over from the hull.
class SeenOutline {
 public:
  SeenOutline(const RadiusModes& wanted, double deformation, double area)
      : wanted_(wanted), deformation_(deformation), wanted_area_(area), area_(area) {
    constexpr double usual_decay = 0.35;
    std::ranges::copy(wanted, modes_.begin());
    for (std::size_t k = wanted_.size(); k < modes_.size(); ++k) modes_[k] = usual_decay * modes_[k - 2];
  }

  /// Brings the modes nearer, and by those beyond, as far as they go, the deformation.
  void improve() {
    const OutlineShape seen = look(coarse_points);
    for (std::size_t k = 0; k < wanted_.size(); ++k) modes_[k] += wanted_[k] - seen.modes[k];
    double slope = 0;  // of the deformation over the common factor of the modes beyond: it is sum (k^2 - 1) c_k^2 / 4
    for (std::size_t k = wanted_.size(); k < modes_.size(); ++k)
      slope += (std::pow(double(k) + min_mode, 2) - 1) / 2 * seen.modes[k] * seen.modes[k];
    const double missing = deformation_ - seen.deformation;
    const double factor = slope > 0 ? 1 + std::clamp(missing / slope, -0.5, 0.5) : 1;
    for (std::size_t k = wanted_.size(); k < modes_.size(); ++k) modes_[k] = factor * seen.modes[k];
  }

  /// Brings the deformation nearer by all modes alike.
  void scale() {
    const double factor = std::sqrt(deformation_ / look(outline_points).deformation);
    for (double& mode : modes_) mode *= factor;
  }

  Eigen::MatrixX2d outline() const { return outline_of_modes(modes_, area_, outline_points); }

 private:
  OutlineShape look(int points) {
    const OutlineShape seen = outline_shape(outline_of_modes(modes_, area_, points));
    area_ *= wanted_area_ / seen.area;
    return seen;
  }

  const RadiusModes& wanted_;
  double deformation_, wanted_area_, area_;
  std::array<double, mode_count> modes_{};
};

}  // namespace

Eigen::MatrixX2d outline_seen_with(const RadiusModes& modes, double deformation, double area) {
  constexpr int improvements = 8, scalings = 3;
  SeenOutline seen(modes, deformation, area);
  for (int i = 0; i < improvements; ++i) seen.improve();
  for (int i = 0; i < scalings; ++i) seen.scale();
  return seen.outline();
}

}  // namespace rheocyte
