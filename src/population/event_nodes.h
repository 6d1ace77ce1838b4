// The likelihood of single events, the radius integrated in closed form and the modulus at nodes
// (docs/theory-populations.md, eq:population).
#pragma once
#include <array>
#include <span>
#include <vector>

#include "population/cell_distribution.h"
#include "population/sample.h"

namespace rheocyte {

/// What the likelihood needs at one node, along the curve of cells with the measured area.
struct EventNode {
  double log_radius, log_modulus;          ///< u* and e
  double residual_area, residual_measure;  ///< measured - that of the cell
  RadiusSlopes slope;                      ///< at constant e
  double area_variance, covariance, measure_variance;
  double log_weight;  ///< of the quadrature, with |de/dx|
};

/// Of one event: ln of its likelihood, the slopes by the parameters, and the cell that it shows.
struct EventAnswer {
  double log_likelihood = 0;
  ParameterVector score = ParameterVector::Zero();
};

/// Posterior means and standard deviations.
struct ShrunkenCell {
  double log_radius, radius_deviation, log_modulus, modulus_deviation;
};

inline constexpr int usual_nodes = 24;

class EventNodes {
 public:
  /// Places the nodes for these parameters. Variances are added to the noise.
  EventNodes(const ForwardMap& map, const SampleEvent& event, const CellDistribution& cells,
             std::array<double, 2> added_variances, int nodes = usual_nodes);

  EventAnswer answer(const CellDistribution& cells, bool with_score) const;
  ShrunkenCell shrunken(const CellDistribution& cells) const;

 private:
  std::vector<EventNode> nodes_;
};

}  // namespace rheocyte
