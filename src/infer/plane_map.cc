#include "infer/plane_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numeric/local_cubic.h"

namespace rheocyte {
namespace {

class PlaneMap : public ForwardMap {
 public:
  explicit PlaneMap(PlaneGrid grid) : grid_(std::move(grid)) {
    assert(grid_.radii >= 4 && grid_.heights >= 4);
    assert(grid_.nodes.size() == std::size_t(grid_.radii * grid_.heights));
    per_u_ = (grid_.radii - 1) / (grid_.log_radii.upper - grid_.log_radii.lower);
  }

  MapPoint at(double u, double x) const override {
    const double held = held_radius(u), height = std::exp(-std::clamp(x, 0.0, grid_.stiffest));
    const int last = grid_.heights - 1;
    const LocalCubic by_u = local_cubic((held - grid_.log_radii.lower) * per_u_, grid_.radii),
                     by_x = local_cubic((1 - height) * last, grid_.heights);
    const double per_x = height * last;
    MapPoint p;
    p.log_area = 2 * held;
    p.log_area_by_radius = 2;
    for (std::size_t i = 0; i < 4; ++i) {
      const PlaneNode* const line = &grid_.nodes[std::size_t((by_u.first + int(i)) * grid_.heights + by_x.first)];
      const double wu = by_u.value[i], su = by_u.slope[i] * per_u_;
      for (std::size_t k = 0; k < 4; ++k) {
        const PlaneNode& n = line[k];
        const double w = wu * by_x.value[k], by_radius = su * by_x.value[k], by_height = wu * by_x.slope[k] * per_x;
        p.log_area += w * n.log_area;
        p.measure += w * n.measure;
        p.log_area_by_radius += by_radius * n.log_area;
        p.measure_by_radius += by_radius * n.measure;
        p.log_area_by_height += by_height * n.log_area;
        p.measure_by_height += by_height * n.measure;
        p.area_variance += w * n.area_variance;
        p.covariance += w * n.covariance;
        p.measure_variance += w * n.measure_variance;
      }
    }
    return p;
  }

  Interval log_radii() const override { return grid_.log_radii; }
  Interval heights() const override { return {0, grid_.stiffest}; }

  SoftEnd soft_end(double u) const override {
    const LocalCubic by_u = local_cubic((held_radius(u) - grid_.log_radii.lower) * per_u_, grid_.radii);
    SoftEnd end{0, 0};
    for (std::size_t i = 0; i < 4; ++i) {
      const double value = grid_.soft_end[std::size_t(by_u.first) + i];
      end.log_modulus += by_u.value[i] * value;
      end.slope += by_u.slope[i] * per_u_ * value;
    }
    return end;
  }

 private:
  double held_radius(double u) const { return std::clamp(u, grid_.log_radii.lower, grid_.log_radii.upper); }

  PlaneGrid grid_;
  double per_u_;
};

}  // namespace

std::shared_ptr<const ForwardMap> make_plane_map(PlaneGrid grid) { return std::make_shared<PlaneMap>(std::move(grid)); }

}  // namespace rheocyte
