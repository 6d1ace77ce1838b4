// What a gate on the measured area leaves of the cells of a law.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "infer/combined_moments.h"

namespace rheocyte {

using Eigen::VectorXd;

std::size_t CombinedMoments::place_of_area() const {
  const auto place = std::ranges::find(features(), int(ShapeFeature::area_um2));
  assert(place != features().end());
  return std::size_t(place - features().begin());
}

GatedValue CombinedMoments::area(const SeenNodes& all) const {
  const VectorXd weighed = all.value.row(Eigen::Index(place_of_area())).transpose().cwiseProduct(all.nodes.weight);
  GatedValue area{weighed.sum(), VectorXd(varying + 1)};
  area.slope << all.nodes.place * weighed, noise_with_area()(Eigen::Index(place_of_area()));
  return area;
}

/// By differences over mean and slopes of the area, whose own slopes by the parameters are exact.
CombinedMoments::NodeSlopes CombinedMoments::slopes_of_kept(const SeenNodes& all) const {
  constexpr double step = 1e-5;
  const GatedValue usual = area(all);
  NodeSlopes slopes;
  for (int number = 0; number <= varying; ++number) {
    GatedValue above = usual, below = usual;
    (number == 0 ? above.mean : above.slope(number - 1)) += step;
    (number == 0 ? below.mean : below.slope(number - 1)) -= step;
    const NormalNodes up = kept_nodes(*gate_, above), down = kept_nodes(*gate_, below);
    const NormalNodes by_number{(up.weight - down.weight) / (2 * step), (up.place - down.place) / (2 * step)};
    for (std::size_t a = 0; a < all.by.size(); ++a) {
      const VectorXd weighed = all.by[a].row(Eigen::Index(place_of_area())).transpose().cwiseProduct(all.nodes.weight);
      const double by = number == 0 ? weighed.sum() : all.nodes.place.row(number - 1).dot(weighed);
      if (number == 0) slopes.push_back({VectorXd::Zero(up.weight.size()), 0 * up.place});
      slopes[a].weight += by * by_number.weight;
      slopes[a].place += by * by_number.place;
    }
  }
  return slopes;
}

double CombinedMoments::kept_fraction(const CombinedVector& parameters) const {
  if (!gate_) return 1;
  return fraction_within(*gate_, area(seen(CombinedLaw::of(parameters), nodes_, {}, false)));
}

ValueGate CombinedMoments::gate_of_table(const CombinedVector& parameters) const {
  constexpr double deviations_from_end = 3;
  const CombinedLaw law = CombinedLaw::of(parameters);
  const Progress of_mean = progress(law);
  const CellBox& box = moduli_.table().box();
  const auto log_area_at = [&](double end) {
    const double radius = end + std::log(scale_.length);
    const Numbers place = (radius - law.mean(0)) / law.root(0, 0) * Numbers::Unit(0);
    return (shape(law, place, of_mean).value + pixels_.middle.bias)(int(ShapeFeature::area_um2));
  };
  const double reach = deviations_from_end * area(seen(law, nodes_, {}, false)).slope.tail(varying).norm();
  return {log_area_at(box.least(x_radius)) + reach, log_area_at(box.greatest(x_radius)) - reach};
}

}  // namespace rheocyte
