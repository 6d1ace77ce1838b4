// The likelihood of single events, the radius integrated in closed form and the modulus at nodes
// (docs/theory-populations.md, eq:population).
#pragma once
#include <Eigen/Core>
#include <array>

#include "population/cell_distribution.h"
#include "population/sample.h"

namespace rheocyte {

/// What the likelihood needs at nodes along the curve of cells with the measured area: numbers of each node.
struct NodeNumber {
  enum Place {
    log_radius,  ///< u*
    log_modulus,
    residual_area,  ///< measured - that of the cell
    residual_measure,
    area_slope,  ///< by u at constant modulus
    measure_slope,
    area_variance,
    covariance,
    measure_variance,
    weight,  ///< of the quadrature, with |de/dx|
    count
  };
};
inline constexpr int usual_nodes = 24, most_nodes = 96;
/// A row for each node; a column of one event's nodes is contiguous.
using NodeTable = Eigen::Array<double, Eigen::Dynamic, NodeNumber::count>;

/// Of one event: ln of its likelihood, the slopes by the parameters, and the cell that it shows.
struct EventAnswer {
  double log_likelihood = 0;
  ParameterVector score = ParameterVector::Zero();
};

/// Posterior means and standard deviations.
struct ShrunkenCell {
  double log_radius, radius_deviation, log_modulus, modulus_deviation;
};

class EventNodes {
 public:
  /// Places the nodes for these parameters, at most most_nodes (asserted). Variances are added to the noise.
  EventNodes(const ForwardMap& map, const SampleEvent& event, const CellDistribution& cells,
             std::array<double, 2> added_variances, int nodes = usual_nodes);

  EventAnswer answer(const CellDistribution& cells, bool with_score) const;
  ShrunkenCell shrunken(const CellDistribution& cells) const;

 private:
  NodeTable nodes_;
};

}  // namespace rheocyte
