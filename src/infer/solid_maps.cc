#include "infer/solid_maps.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "infer/plane_map.h"
#include "numeric/local_cubic.h"

namespace rheocyte {
namespace {

/// Nodes in u, in the height of the branch and over the axial ratio; cubics between them.
constexpr int radius_nodes = 29, height_nodes = 33, axial_nodes = 13;
/// In place of a height of 0, where ln E would be infinite.
constexpr double stiffest_node = 1e-6;
/// The stiffest cell of the maps, in ln E above the softest.
constexpr double stiffest = 7;
constexpr int cell_steps = 6, newton_steps = 8;
constexpr double settled_step = 1e-9;

/// The numbers of one node of the sheets; by the first ones a cell is found.
struct SheetNumber {
  enum Place {
    log_modulus,
    elongation,
    log_area,
    measure,
    area_variance,
    area_covariance,
    elongation_variance,
    elongation_covariance,
    measure_variance,
    area_elongation_covariance,
    count,  ///< an even one is faster
    that_find = log_area
  };
};
using NodeNumbers = Eigen::Array<double, SheetNumber::count, 1>;

}  // namespace

/// The table through pixels on a grid of (u, height, axial ratio), in the recording's channel.
class SolidMaps::Sheets {
 public:
  Sheets(const ElongatedLiquid& liquid, const ChannelFlow& flow, const SolidImages& images, StiffnessMeasure by)
      : liquid_(liquid),
        table_(liquid.solids().table()),
        pixel_size_um_(images.pixel_size_um),
        by_(by),
        length_(factors_of(flow).length),
        outline_errors_(images.outline) {
    assert(by == StiffnessMeasure::asymmetry || !images.outline);
    log_modulus_factor_ = std::log(factors_of(flow).modulus);
    first_u_ = std::log(table_.radius_um(0) * length_);
    step_u_ = (std::log(table_.radius_um(1) * length_) - first_u_) / (radius_nodes - 1);
    first_axial_ = table_.least()(1);
    step_axial_ = (table_.greatest()(1) - first_axial_) / (axial_nodes - 1);
    nodes_.reserve(std::size_t(radius_nodes * height_nodes * axial_nodes));
    for (int i = 0; i < radius_nodes; ++i)
      for (int k = 0; k < height_nodes; ++k)
        for (int j = 0; j < axial_nodes; ++j) nodes_.push_back(numbers_of({coordinate(i), axial_at(j), height_at(k)}));
  }

  /// Two cells of equal modulus and measured elongation, of different radius, lie on one line of this map.
  std::shared_ptr<const ForwardMap> map(double elongation) const {
    PlaneGrid grid{{first_u_, first_u_ + step_u_ * (radius_nodes - 1)}, stiffest, radius_nodes, height_nodes, {}, {}};
    for (int i = 0; i < radius_nodes; ++i) {
      const Place soft = place_on(i, elongation, {1, first_axial_for(elongation)});
      const double end = log_modulus_at(i, soft);
      grid.soft_end.push_back(end);
      Place place = soft;
      for (int k = height_nodes - 1; k >= 0; --k) {  // from soft to stiff
        place = place_of(i, elongation, end - std::log(height_at(k)), place);
        grid.nodes.push_back(node_at(i, place));
      }
    }
    return make_plane_map(std::move(grid));
  }

  Cell cell(double elongation, double u, double x) const {
    const double at = std::clamp((u - first_u_) / step_u_, 0.0, double(radius_nodes - 1));
    const int node = std::clamp(int(std::lround(at)), 0, radius_nodes - 1);
    // The place at the nearest radius, and from there the cell of this radius itself.
    Place place = place_on(node, elongation, {1, first_axial_for(elongation)});
    place = place_of(node, elongation, log_modulus_at(node, place) + x,
                     {std::max(place.height * std::exp(-x), stiffest_node), place.axial});
    const double coordinate = table_.coordinate_of(std::exp(u) / length_);
    return {table_.at({coordinate, place.axial, place.height}), place.axial};
  }

  ShapeErrors outline_errors(const ElongatedState& state) const {
    if (!outline_errors_) return {};
    const SolidFeatures smooth = features_of(state, length_);
    return outline_errors_->at(smooth.log_area, smooth.modes.mode_2, smooth.modes.mode_3);
  }

  SolidFeatures seen(const ElongatedState& state, const ShapeVector& outline_bias) const {
    SolidFeatures seen = through_pixels(features_of(state, length_), by_, pixel_size_um_);
    seen.log_area += outline_bias(int(ShapeFeature::area_um2));
    seen.deformation += outline_bias(int(ShapeFeature::deformation));
    // The moment ratio is the inertia ratio to the power of -2.
    seen.inertia_ratio -= std::pow(seen.inertia_ratio, 3) / 2 * outline_bias(int(ShapeFeature::moment_ratio));
    seen.modes.mode_2 += outline_bias(feature_of_mode(2));
    seen.modes.mode_3 += outline_bias(feature_of_mode(3));
    seen.modes.mode_4 += outline_bias(feature_of_mode(4));
    seen.modes.mode_5 += outline_bias(feature_of_mode(5));
    return seen;
  }

  ForwardMap::Interval elongations() const {
    double least = -1e300, greatest = 1e300;
    for (int i = 0; i < radius_nodes; ++i) {
      least = std::max(least, node(i, 0, 0)(SheetNumber::elongation));
      for (int k = 0; k < height_nodes; ++k)
        greatest = std::min(greatest, node(i, k, axial_nodes - 1)(SheetNumber::elongation));
    }
    return {least, greatest};
  }

 private:
  struct Place {
    double height, axial;
  };
  /// The first numbers of a place, with their slopes.
  template <int numbers>
  struct FirstNumbers {
    using Values = Eigen::Array<double, numbers, 1>;
    Values value = Values::Zero(), by_height = Values::Zero(), by_axial = Values::Zero();
  };
  using Sum = FirstNumbers<SheetNumber::count>;

  ScaleFactors factors_of(const ChannelFlow& flow) const {
    return scale_factors(table_.origin().flow, {flow.width_um, flow.rate_ul_s, 1, flow.exponent});
  }
  double coordinate(int i) const { return table_.coordinate_of(std::exp(first_u_ + i * step_u_) / length_); }
  double axial_at(int j) const { return first_axial_ + j * step_axial_; }
  static double height_at(int k) { return k == 0 ? stiffest_node : double(k) / (height_nodes - 1); }
  const NodeNumbers& node(int i, int k, int j) const {
    return nodes_[std::size_t((i * height_nodes + k) * axial_nodes + j)];
  }

  /// ln E + ln(height), ln A - 2 u, elongation and measure, and the noise of these.
  NodeNumbers numbers_of(const ElongatedCell& cell) const {
    const ElongatedState state = table_.at(cell);
    const ShapeErrors outline = outline_errors(state);
    const SolidFeatures features = seen(state, outline.bias);
    const std::array told{int(ShapeFeature::area_um2), feature_of_mode(2), feature_of_mode(3)};
    const Eigen::Matrix3d noise = noise_of(features, by_, pixel_size_um_) + outline.covariance(told, told);
    NodeNumbers all;
    all << state.log_modulus + std::log(cell(2)) + log_modulus_factor_ + std::log(liquid_.modulus_ratio(cell)),
        elongation_of(features, by_), features.log_area - 2 * std::log(state.radius_um * length_),
        measure_of(features, by_), noise(0, 0), noise(0, 2), noise(1, 1), noise(1, 2), noise(2, 2), noise(0, 1);
    return all;
  }

  /// At the radius of a node.
  template <int numbers = SheetNumber::count>
  FirstNumbers<numbers> sum_at(int i, const Place& place) const {
    const LocalCubic h = local_cubic(place.height * (height_nodes - 1), height_nodes),
                     a = local_cubic((place.axial - first_axial_) / step_axial_, axial_nodes);
    FirstNumbers<numbers> sum;
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t j = 0; j < 4; ++j) {
        const auto n = node(i, h.first + int(k), a.first + int(j)).template head<numbers>();
        sum.value += h.value[k] * a.value[j] * n;
        sum.by_height += h.slope[k] * a.value[j] * (height_nodes - 1) * n;
        sum.by_axial += h.value[k] * a.slope[j] / step_axial_ * n;
      }
    return sum;
  }
  FirstNumbers<SheetNumber::that_find> found_by(int i, const Place& place) const {
    return sum_at<SheetNumber::that_find>(i, place);
  }

  double log_modulus_at(int i, const Place& place) const {
    return found_by(i, place).value(SheetNumber::log_modulus) - std::log(place.height);
  }

  double first_axial_for(double wanted) const {
    if (by_ == StiffnessMeasure::deformation) return 0;
    const double mode_2 = by_ == StiffnessMeasure::asymmetry ? wanted : (wanted - 1) / (wanted + 1);
    return std::clamp(mode_2 / 0.75, table_.least()(1), table_.greatest()(1));
  }

  /// At a height the place with a measured elongation; at the rim of the table where there is none.
  Place place_on(int i, double elongation, Place start) const {
    if (by_ == StiffnessMeasure::deformation) return {start.height, 0};
    for (int step = 0; step < cell_steps; ++step) {
      const auto sum = found_by(i, start);
      const double move = (elongation - sum.value(SheetNumber::elongation)) / sum.by_axial(SheetNumber::elongation);
      start.axial = std::clamp(start.axial + move, table_.least()(1), table_.greatest()(1));
      if (std::abs(move) < settled_step) break;
    }
    return start;
  }

  /// With a measured elongation and a modulus.
  Place place_of(int i, double elongation, double log_modulus, Place start) const {
    if (const auto place = place_by_newton(i, elongation, log_modulus, start)) return *place;
    for (int step = 0; step < cell_steps; ++step) {
      start = place_on(i, elongation, start);
      const double height = std::exp(found_by(i, start).value(SheetNumber::log_modulus) - log_modulus);
      const double change = height / start.height - 1;
      start.height = std::clamp(height, stiffest_node, 1.0);
      if (std::abs(change) < settled_step) break;
    }
    return place_on(i, elongation, start);
  }

  /// The same where it lies within the table, without its rim.
  std::optional<Place> place_by_newton(int i, double elongation, double log_modulus, Place at) const {
    if (by_ == StiffnessMeasure::deformation) return {};
    double log_height = std::log(at.height);
    for (int step = 0; step < newton_steps; ++step) {
      const auto sum = found_by(i, at);
      const double off_modulus = log_modulus - (sum.value(SheetNumber::log_modulus) - log_height),
                   off_elongation = elongation - sum.value(SheetNumber::elongation);
      // Slopes by ln(height) and the axial ratio.
      const double mh = at.height * sum.by_height(SheetNumber::log_modulus) - 1,
                   ma = sum.by_axial(SheetNumber::log_modulus), eh = at.height * sum.by_height(SheetNumber::elongation),
                   ea = sum.by_axial(SheetNumber::elongation);
      const double det = mh * ea - ma * eh;
      const double up = (off_modulus * ea - ma * off_elongation) / det,
                   along = (mh * off_elongation - eh * off_modulus) / det;
      log_height += up;
      at.axial += along;
      at.height = std::exp(log_height);
      const bool is_inside = at.height > stiffest_node && at.height <= 1 && at.axial >= table_.least()(1) &&
                             at.axial <= table_.greatest()(1);
      if (!is_inside) return {};
      if (std::abs(up) < settled_step && std::abs(along) < settled_step) return at;
    }
    return {};
  }

  /// The elongation, of which nothing is assumed, is eliminated with its noise (eq:eliminated-elongation).
  PlaneNode node_at(int i, const Place& place) const {
    const Sum sum = sum_at(i, place);
    const auto value = [&](SheetNumber::Place n) { return sum.value(n); };
    PlaneNode result{value(SheetNumber::log_area), value(SheetNumber::measure), value(SheetNumber::area_variance),
                     value(SheetNumber::area_covariance), value(SheetNumber::measure_variance)};
    if (by_ == StiffnessMeasure::deformation) return result;
    // Slopes at constant modulus: the height changes with the axial ratio.
    const double height_by_axial =
        sum.by_axial(SheetNumber::log_modulus) / (1 / place.height - sum.by_height(SheetNumber::log_modulus));
    const auto slope = [&](SheetNumber::Place n) { return sum.by_axial(n) + height_by_axial * sum.by_height(n); };
    const double of_area = slope(SheetNumber::log_area) / slope(SheetNumber::elongation),
                 of_measure = slope(SheetNumber::measure) / slope(SheetNumber::elongation);
    const double variance = value(SheetNumber::elongation_variance),
                 covariance = value(SheetNumber::elongation_covariance);
    const double with_area = value(SheetNumber::area_elongation_covariance);
    result.area_variance += of_area * of_area * variance;
    result.area_variance -= 2 * of_area * with_area;
    result.covariance += of_area * of_measure * variance - of_area * covariance;
    result.covariance -= of_measure * with_area;
    result.measure_variance += of_measure * of_measure * variance - 2 * of_measure * covariance;
    return result;
  }

  const ElongatedLiquid& liquid_;
  const ElongatedTable& table_;
  double pixel_size_um_;
  StiffnessMeasure by_;
  double length_;
  std::shared_ptr<const OutlineErrors> outline_errors_;
  double log_modulus_factor_, first_u_, step_u_, first_axial_, step_axial_;
  std::vector<NodeNumbers> nodes_;
};

SolidMaps::SolidMaps(const ElongatedLiquid& liquid, const ChannelFlow& flow, const SolidImages& images,
                     StiffnessMeasure by)
    : by_(by), sheets_(std::make_unique<const Sheets>(liquid, flow, images, by)) {}
SolidMaps::~SolidMaps() = default;

ForwardMap::Interval SolidMaps::elongations() const { return sheets_->elongations(); }
std::shared_ptr<const ForwardMap> SolidMaps::at(double elongation) const { return sheets_->map(elongation); }
SolidMaps::Cell SolidMaps::cell(double elongation, double u, double x) const { return sheets_->cell(elongation, u, x); }

ShapeErrors SolidMaps::outline_errors(const Cell& cell) const { return sheets_->outline_errors(cell.state); }
SolidFeatures SolidMaps::seen(const Cell& cell) const { return sheets_->seen(cell.state, outline_errors(cell).bias); }

}  // namespace rheocyte
