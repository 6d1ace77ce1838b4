#include "duct/farthest_place.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>

namespace rheocyte {
namespace {

constexpr int samples_per_edge = 9, refinements = 12;
/// Faces whose samples stay behind the farthest one by more than this (in radii) cannot reach farther.
constexpr double hopeless = 0.02;

bool is_held(double coordinate, double slope) {
  return (coordinate <= 0 && slope <= 0) || (coordinate >= 1 && slope >= 0);
}

/// Newton's step towards the greatest height within a face.
Eigen::Vector2d step_within(const SurfaceJet& here, const SurfacePlace& at, const DuctPoint& direction) {
  const Eigen::Vector2d slope(here.s.dot(direction), here.t.dot(direction));
  Eigen::Matrix2d second;
  second << here.ss.dot(direction), here.st.dot(direction), here.st.dot(direction), here.tt.dot(direction);
  const std::array held{is_held(at.s, slope(0)), is_held(at.t, slope(1))};
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  if (!held[0] && !held[1]) {
    if (second(0, 0) < 0 && second.determinant() > 0) step = -second.inverse() * slope;
    return step;
  }
  for (int c = 0; c < 2; ++c) {
    if (!held[c] && second(c, c) < 0) step(c) = -slope(c) / second(c, c);
  }
  return step;
}

}  // namespace

FarthestPlace::FarthestPlace(const DuctSurfaceMap& surface) : surface_(surface) {
  constexpr double step = 1.0 / (samples_per_edge - 1);
  for (int f = 0; f < int(surface.faces().size()); ++f) {
    for (int row = 0; row < samples_per_edge; ++row) {
      for (int column = 0; column < samples_per_edge; ++column) samples_.push_back({f, step * column, step * row});
    }
  }
  sampled_.resize(Eigen::Index(samples_.size()), 3);
  for (std::size_t i = 0; i < samples_.size(); ++i)
    sampled_.row(Eigen::Index(i)) = surface.now(samples_[i]).x.transpose();
}

SurfacePlace FarthestPlace::operator()(const DuctPoint& direction) const {
  constexpr int of_face = samples_per_edge * samples_per_edge;
  const VectorXd heights = sampled_ * direction;
  int first = 0;
  const double hopeful = heights.maxCoeff(&first) - hopeless * surface_.space().mesh().geometry().radius();
  SurfacePlace farthest = samples_[first];
  double reached = heights(first);
  for (int f = 0; f < int(surface_.faces().size()); ++f) {
    int best = 0;
    if (heights.segment(f * of_face, of_face).maxCoeff(&best) < hopeful) continue;
    const SurfacePlace place = climb(samples_[f * of_face + best], direction);
    const double height = surface_.now(place).x.dot(direction);
    if (height <= reached) continue;
    reached = height;
    farthest = place;
  }
  return farthest;
}

SurfacePlace FarthestPlace::climb(SurfacePlace at, const DuctPoint& direction) const {
  SurfaceJet here = surface_.now(at);
  for (int k = 0; k < refinements; ++k) {
    const Eigen::Vector2d step = step_within(here, at, direction);
    const SurfacePlace next{at.face, std::clamp(at.s + step(0), 0.0, 1.0), std::clamp(at.t + step(1), 0.0, 1.0)};
    const SurfaceJet there = surface_.now(next);
    if (!(there.x.dot(direction) > here.x.dot(direction))) break;
    at = next;
    here = there;
  }
  return at;
}

}  // namespace rheocyte
