#include "fem/channel_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/problem.h"
#include "shape/curve.h"

namespace rheocyte {
namespace {

std::vector<double> uniform(int n) {
  std::vector<double> breaks(n + 1);
  for (int i = 0; i <= n; ++i) breaks[i] = double(i) / n;
  return breaks;
}

/// Breaks in [0, 1] whose intervals grow by the constant factor that multiplies 1 to `ratio` over all of them.
std::vector<double> graded(int n, double ratio) {
  if (std::abs(ratio - 1) < 1e-3) return uniform(n);
  std::vector<double> breaks = uniform(n);
  for (double& b : breaks) b = (std::pow(ratio, b) - 1) / (ratio - 1);
  return breaks;
}

}  // namespace

std::vector<double> like(const std::vector<double>& breaks, int n) {
  std::vector<double> between = uniform(n);
  const int last = int(breaks.size()) - 2;
  for (double& b : between) {
    const double place = b * (last + 1);
    const int i = std::min(int(place), last);
    b = std::lerp(breaks[i], breaks[i + 1], place - i);
  }
  return between;
}

SurfaceBreaks like(const SurfaceBreaks& breaks, const SurfaceBreaks& numbers) {
  const int top = int(numbers.top.size()) - 1;
  return {like(breaks.front, int(numbers.front.size()) - 1), like(breaks.top, top),
          breaks.axis.empty() ? breaks.axis : like(breaks.axis, top)};
}

namespace {

std::vector<double> front_breaks(int n, Spacing spacing) {
  return spacing == Spacing::even ? uniform(n) : like({0, 0.35, 1}, n);
}

/// The ring lies between 0.69 (soft cells) and 0.99 (small stiff ones) of the top (docs/theory.md, sec. "Mesh").
std::vector<double> top_breaks(int n, Spacing spacing) {
  return spacing == Spacing::even ? uniform(n) : like({0, 0.25, 0.5, 0.7, 0.76, 0.82, 0.88, 0.94, 1}, 2 * n);
}

/// From the box to the end of the mesh: one element more where the channel is longer than it need be, and some for the
/// way beyond it.
std::vector<double> axial_breaks(const ChannelGeometry& geometry, int n) {
  constexpr double longest = 1.25;  // of the elements beyond
  const double box = geometry.box(), half = geometry.half_length(), least = min_half_length(geometry.radius());
  std::vector<double> places = graded(n, 1.3);
  for (double& x : places) x = box + x * (least - box);
  if (half > least) places.push_back(half);
  const int beyond = int(std::ceil((geometry.end() - half) / longest - 1e-9));
  for (int i = 1; i <= beyond; ++i) places.push_back(half + (geometry.end() - half) * i / beyond);
  for (double& x : places) x = (x - box) / (geometry.end() - box);
  places.back() = 1;
  return places;
}

bool runs_outward_first(Block block) {
  return block != Block::ring_rear && block != Block::rear && block != Block::upstream;
}

}  // namespace

int layers_for(const ChannelGeometry& geometry, const Subdivision& n) {
  constexpr double first_layer_height = 0.5;  // relative to the width of the surface's elements
  const double width = geometry.radius() * geometry.angle(Sector::front, 1) / n.front;
  const double first = first_layer_height * width / (geometry.box() - geometry.radius());
  return std::max(1, int(std::lround(std::log2(1 + 1 / first))));
}

Point MeshElement::map(const ChannelGeometry& geometry, double xi1, double xi2) const {
  const auto [o, a] = parameters(xi1, xi2);
  return geometry.map(block, o, a);
}

std::array<double, 2> MeshElement::parameters(double xi1, double xi2) const {
  const double o = outward_first ? xi1 : xi2, a = outward_first ? xi2 : xi1;
  const double out = outward[0] + o * (outward[1] - outward[0]), outside = along[0] + a * (along[1] - along[0]);
  if (!is_skewed()) return {out, outside};
  return {out, out * outside + (1 - out) * (along_axis[0] + a * (along_axis[1] - along_axis[0]))};
}

std::array<double, 2> MeshElement::coordinates(double out, double at) const {
  const double first = is_skewed() ? out * along[0] + (1 - out) * along_axis[0] : along[0],
               last = is_skewed() ? out * along[1] + (1 - out) * along_axis[1] : along[1];
  const double o = (out - outward[0]) / (outward[1] - outward[0]), a = (at - first) / (last - first);
  return outward_first ? std::array{o, a} : std::array{a, o};
}

SurfaceBreaks surface_breaks(const Subdivision& n, Spacing spacing) {
  return {front_breaks(n.front, spacing), top_breaks(n.top, spacing), {}};
}

ChannelMesh::ChannelMesh(const ChannelGeometry& geometry, const Subdivision& n, SurfaceBreaks breaks)
    : geometry_(geometry), breaks_(std::move(breaks)) {
  const auto ring = uniform(n.ring);
  const int layer_count = n.layers > 0 ? n.layers : layers_for(geometry, n);
  const auto layers = graded(layer_count, std::pow(2.0, layer_count));
  const auto axial = axial_breaks(geometry, n.axial);
  const auto add = [this](Block block, const std::vector<double>& outward, const std::vector<double>& along) {
    add_block(block, outward, along, along);
  };
  add_block(Block::core, breaks_.front, breaks_.top, breaks_.axis.empty() ? breaks_.top : breaks_.axis);
  add(Block::ring_front, ring, breaks_.front);
  add(Block::ring_top, ring, breaks_.top);
  add(Block::ring_rear, ring, breaks_.front);
  add(Block::front, layers, breaks_.front);
  add(Block::top, layers, breaks_.top);
  add(Block::rear, layers, breaks_.front);
  add(Block::downstream, axial, breaks_.front);
  add(Block::upstream, axial, breaks_.front);
}

void ChannelMesh::add_block(Block block, const std::vector<double>& outward, const std::vector<double>& along,
                            const std::vector<double>& along_axis) {
  for (std::size_t i = 0; i + 1 < outward.size(); ++i) {
    for (std::size_t j = 0; j + 1 < along.size(); ++j) {
      elements_.push_back({block,
                           runs_outward_first(block),
                           {outward[i], outward[i + 1]},
                           {along[j], along[j + 1]},
                           {along_axis[j], along_axis[j + 1]}});
    }
  }
}

std::vector<double> ChannelMesh::surface_places() const {
  std::vector<double> places = breaks_.front;
  for (std::size_t i = 1; i < breaks_.top.size(); ++i) places.push_back(1 + 2 * breaks_.top[i]);
  for (std::size_t i = breaks_.front.size() - 1; i-- > 0;) places.push_back(4 - breaks_.front[i]);
  return places;
}

NodeNumbers ChannelMesh::number_nodes(int degree) const {
  const Eigen::VectorXd& s = lobatto_nodes(degree);
  const int n = degree + 1;
  return rheocyte::number_nodes<2>(int(elements_.size()), n * n,
                                   [&](int e, int k) { return elements_[e].map(geometry_, s(k % n), s(k / n)); });
}

}  // namespace rheocyte
