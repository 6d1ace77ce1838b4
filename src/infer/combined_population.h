// The population of cells with bulk, cortex and tension that a recording shows, by a combined table
// (docs/theory-populations.md, sec. "Several moduli").
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "infer/bulk_cortex_fit.h"
#include "infer/combined_law.h"
#include "infer/rendered_errors.h"
#include "infer/seen_cells.h"
#include "population/fit_moments.h"

namespace rheocyte {

/// Mean and covariance of the features that are seen of cells of a law: in pixels, in the recording's channel.
class CombinedMoments : public MomentModel {
 public:
  /// The viscosity of the sight's flow is that of the median event. The table must outlive it.
  CombinedMoments(const BulkCortexFit& moduli, const Sight& sight, double pixel_size_um);

  Moments at(const Eigen::VectorXd& parameters) const override { return slopes_or_not(parameters, false).there; }
  MomentSlopes slopes(const Eigen::VectorXd& parameters) const override { return slopes_or_not(parameters, true); }
  int means() const override { return int(CombinedParameter::log_radius_spread); }
  /// Pictures of cells of this law, about so many in all, tell what pixels do from now on. False if most of its cells
  /// are none.
  bool render(const CombinedVector& parameters, std::size_t pictures);
  /// Slopes of the mean features by ln of the viscosity of the liquid, whose tension goes with the wall's shear stress.
  Eigen::VectorXd by_log_viscosity(const CombinedVector& parameters) const;
  /// By how much the mean features of cells that differ are not those of the mean cell.
  Eigen::VectorXd bend(const CombinedVector& parameters) const;
  /// The mean cell of a law, in the table.
  CellCoordinates mean_cell(const CombinedVector& parameters) const;
  /// What the table, and in the square channel the law that brings it there, leaves and all events have in common.
  Eigen::MatrixXd common_covariance(const CombinedVector& parameters) const;

  /// Until then they do this.
  void take_pixels(const ShapeErrors& errors) { pixels_.middle = errors; }
  /// All features of so many virtual events of this law.
  std::vector<ShapeVector> drawn(const CombinedVector& parameters, std::size_t events) const;
  /// The same without pixels.
  std::vector<ShapeVector> drawn_smooth(const CombinedVector& parameters, std::size_t events, std::uint64_t seed) const;

  const std::vector<int>& features() const { return moduli_.features(); }

 private:
  static constexpr int varying = combined_numbers + 2;
  /// Of the numbers of a cell: the three of the law's mean, the tension of the cortex over E2D, and that of the liquid
  /// (kPa).
  using Numbers = Eigen::Matrix<double, varying, 1>;
  struct Node {
    double weight;
    Numbers place;  ///< in standard deviations
  };
  struct Shape {
    ShapeVector value;
    Eigen::Matrix<double, feature_count, varying> by_number;
    double progress;
    Numbers progress_by_number;
  };
  /// Of the mean cell, and what it changes by with the numbers.
  struct Progress {
    double value;
    Numbers by_number, mean;
    double at(const Numbers& numbers) const { return value + by_number.dot(numbers - mean); }
  };
  /// In the channel, without pixels.
  Shape shape(const CombinedLaw& law, const Node& node, const Progress& progress) const;
  CellCoordinates place_in_table(const Numbers& numbers, double log_progress) const;
  /// `first`: where the search for the deformation begins (ln of the progress).
  Shape shape_in_tube(const Numbers& numbers, double first) const;
  Progress progress(const CombinedLaw& law) const;
  ShapeErrors section(const Numbers& numbers, const ShapeVector& in_tube) const;
  Numbers numbers(const CombinedLaw& law, const Node& node) const;
  /// Slopes of the numbers by the parameters.
  Eigen::Matrix<double, varying, combined_parameters> by_parameters(const CombinedLaw& law, const Node& node) const;
  MomentSlopes slopes_or_not(const Eigen::VectorXd& parameters, bool with_slopes) const;
  static std::vector<Node> nodes();
  static Node drawn_node(std::uint64_t seed, std::uint64_t number);

  const BulkCortexFit& moduli_;
  Sight sight_;
  double pixel_size_um_, wall_stress_kPa_;
  ScaleFactors scale_;
  std::vector<Node> nodes_ = nodes();
  /// What pixels add: linear over the place of a cell in the law, with the same noise for all.
  struct {
    ShapeErrors middle;
    Eigen::Matrix<double, feature_count, varying> slope = Eigen::Matrix<double, feature_count, varying>::Zero();
  } pixels_;
};

struct CombinedPopulation {
  MomentFit fit;  ///< `parameters` are a CombinedVector
  CombinedLaw law;
  /// Of the parameters, by what all events have in common: table, section, and what these miss.
  Eigen::MatrixXd common_covariance;
  std::vector<int> features;       ///< that were fitted, of ShapeFeature
  Eigen::VectorXd residual;        ///< of their means, measured - fitted
  Eigen::VectorXd bend;            ///< of the law, see CombinedMoments
  CellCoordinates mean_cell;       ///< of the law, in the table, which may end before
  std::vector<ShapeVector> drawn;  ///< virtual events of the law
};

/// Not found: no cell of the table is like the median one, or the events do not tell the parameters. Shapes in pixels
/// and finite, in flows that differ from the sight's in the viscosity alone.
CombinedPopulation fit_combined_population(const BulkCortexFit& moduli, const Sight& sight, double pixel_size_um,
                                           std::span<const MeasuredCell> cells, const std::function<void()>& goes_on);

}  // namespace rheocyte
