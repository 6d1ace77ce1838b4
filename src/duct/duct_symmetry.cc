#include "duct/duct_symmetry.h"

namespace rheocyte {

std::vector<Image> wedges_of(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::eighth: return {{}};
    case Symmetry::quarter: return {{}, {true}};
    case Symmetry::half: return {{}, {true}, {false, -1}, {true, -1}};
  }
  return {};
}

std::vector<Image> copies_of(Symmetry symmetry) {
  std::vector<Image> copies;
  for (const bool swaps : {false, true}) {
    for (const double z : {1.0, -1.0}) {
      for (const double y : {1.0, -1.0}) {
        const bool belongs = symmetry == Symmetry::eighth || (!swaps && (symmetry == Symmetry::quarter || y > 0));
        if (belongs) copies.push_back({swaps, y, z});
      }
    }
  }
  return copies;
}

Across across_at(Symmetry symmetry, const DuctPoint& x) {
  const bool on_side = x(2) < same_place;
  const bool on_diagonal = symmetry == Symmetry::eighth && x(1) - x(2) < same_place;
  const bool on_front = symmetry == Symmetry::quarter && x(1) < same_place;
  return {.holds_y = on_front || (on_side && on_diagonal), .holds_z = on_side, .ties = on_diagonal && !on_side};
}

std::vector<Camera> mirror_cameras(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::eighth: return {Camera::side, Camera::diagonal};
    case Symmetry::quarter: return {Camera::side, {90}};
    case Symmetry::half: return {Camera::side};
  }
  return {};
}

Camera nearest_mirror(Symmetry symmetry, Camera camera) {
  if (symmetry == Symmetry::half) return Camera::side;
  if (symmetry == Symmetry::quarter) return {camera.degrees > 45 ? 90.0 : 0.0};
  const double folded = camera.degrees > 45 ? 90 - camera.degrees : camera.degrees;
  return folded > 22.5 ? Camera::diagonal : Camera::side;
}

}  // namespace rheocyte
