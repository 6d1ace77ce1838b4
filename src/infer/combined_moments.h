// What is seen of cells with bulk, cortex and tensions that are distributed by a law: mean and covariance of the
// features in pixels (docs/theory-populations.md, eq:moments).
#pragma once
#include <optional>
#include <vector>

#include "infer/bulk_cortex_fit.h"
#include "infer/combined_law.h"
#include "infer/rendered_errors.h"
#include "measurement/outline_noise.h"
#include "population/fit_moments.h"
#include "population/normal_nodes.h"

namespace rheocyte {

/// Cells of a law that its table does not have.
struct CellsBeyond {
  std::size_t all = 0, within = 0, softer = 0;
  std::size_t longer = 0;  ///< their axial tension is a greater part of their stiffness
  /// If these two are more than half: of each ln(S / kPa) of the softest cell of the table with its other numbers.
  std::vector<double> log_stiffness_of_last = {};
};

/// Mean and covariance of the features that are seen of cells of a law: in pixels, in the recording's channel.
class CombinedMoments : public MomentModel {
 public:
  /// The viscosity of the sight's flow is that of the median event. Pictures have such errors of the outline (um). The
  /// table must outlive it.
  CombinedMoments(const BulkCortexFit& moduli, const Sight& sight, double pixel_size_um,
                  const OutlineNoise& outline_noise = {});

  Moments at(const Eigen::VectorXd& parameters) const override { return moments(parameters, false).there; }
  MomentSlopes slopes(const Eigen::VectorXd& parameters) const override { return moments(parameters, true); }
  int means() const override { return int(CombinedParameter::log_radius_spread); }

  /// From now on moments, pictures and virtual events are those of the cells whose measured ln of the area passes.
  void take_gate(const ValueGate& gate) { gate_ = gate; }
  /// Of the cells of a law.
  double kept_fraction(const CombinedVector& parameters) const;
  /// Areas that no cells but those of the table's sizes have, to three standard deviations of what is measured of cells
  /// of one size.
  ValueGate gate_of_table(const CombinedVector& parameters) const;

  /// Pictures of cells of this law, about so many in all, tell what pixels do from now on. False if most of its cells
  /// are none.
  bool render(const CombinedVector& parameters, std::size_t pictures);
  /// Until then they do this.
  void take_pixels(const ShapeErrors& errors) { pixels_.middle = errors; }

  /// Slopes of the mean features of all cells by ln of the viscosity of the liquid, whose tension goes with the wall's
  /// shear stress.
  Eigen::VectorXd by_log_viscosity(const CombinedVector& parameters) const;
  /// The mean cell of a law, in the table.
  CellCoordinates mean_cell(const CombinedVector& parameters) const;
  /// What the table, and in the square channel the law that brings it there, leaves and all events have in common.
  Eigen::MatrixXd common_covariance(const CombinedVector& parameters) const;

  /// Of about so many virtual cells of this law, whether or not they pass.
  CellsBeyond beyond(const CombinedVector& parameters, std::size_t cells) const;

  /// All features of about so many virtual events of this law.
  std::vector<ShapeVector> drawn(const CombinedVector& parameters, std::size_t events) const;
  /// Of all cells, without pixels.
  std::vector<ShapeVector> drawn_smooth(const CombinedVector& parameters, std::size_t events, std::uint64_t seed) const;

  const std::vector<int>& features() const { return moduli_.features(); }

 private:
  static constexpr int varying = combined_numbers + 2;
  /// Of the numbers of a cell: the three of the law's mean, the tension of the cortex over E2D, and that of the liquid
  /// (kPa); or where a cell stands in its law, in standard deviations.
  using Numbers = Eigen::Matrix<double, varying, 1>;
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
  /// What is seen at the nodes of a law. Where nodes have a number more than cells, it is the noise of the measured
  /// area in its standard deviations, and is no part of the noise that remains.
  struct SeenNodes {
    NormalNodes nodes;
    Eigen::MatrixXd value;            ///< features by nodes
    std::vector<Eigen::MatrixXd> by;  ///< its slopes by each parameter, if they are requested
    Eigen::MatrixXd noise;
  };
  /// What nodes change by with each parameter; empty if they stay where they are.
  using NodeSlopes = std::vector<NormalNodes>;

  /// In the channel, without pixels.
  Shape shape(const CombinedLaw& law, const Numbers& place, const Progress& progress) const;
  CellCoordinates place_in_table(const Numbers& numbers, double log_progress) const;
  enum class Side { within, softer, longer };
  /// On which side of the table a cell lies; `first` as below.
  Side side(const Numbers& numbers, double first) const;
  /// ln(S / kPa) of the softest cell of the table with these numbers, the stiffness aside; infinite far beyond it.
  double softest(Numbers numbers, double first) const;
  /// `first`: where the search for the deformation begins (ln of the progress).
  Shape shape_in_tube(const Numbers& numbers, double first) const;
  Progress progress(const CombinedLaw& law) const;
  ShapeErrors section(const Numbers& numbers, const ShapeVector& in_tube) const;
  Numbers numbers(const CombinedLaw& law, const Numbers& place) const;
  /// Slopes of the numbers by the parameters.
  Eigen::Matrix<double, varying, combined_parameters> by_parameters(const CombinedLaw& law, const Numbers& place) const;
  /// And by the place.
  Eigen::Matrix<double, varying, varying> by_place(const CombinedLaw& law) const;

  MomentSlopes moments(const Eigen::VectorXd& parameters, bool with_slopes) const;
  static MomentSlopes moments_of(const SeenNodes& seen, const NodeSlopes& moved);
  SeenNodes seen(const CombinedLaw& law, const NormalNodes& nodes, const NodeSlopes& moved, bool with_slopes) const;
  /// Of the measured features, by a standard deviation of the noise of the area.
  Eigen::VectorXd noise_with_area() const;
  std::size_t place_of_area() const;
  /// The measured ln of the area, linear in the place and the noise.
  GatedValue area(const SeenNodes& all) const;
  NodeSlopes slopes_of_kept(const SeenNodes& all) const;
  bool passes(double log_area) const { return !gate_ || gate_->pass(log_area); }
  static Numbers drawn_place(std::uint64_t seed, std::uint64_t number);

  const BulkCortexFit& moduli_;
  Sight sight_;
  double pixel_size_um_, wall_stress_kPa_;
  OutlineNoise outline_noise_;
  ScaleFactors scale_;
  NormalNodes nodes_ = normal_nodes(varying);
  std::optional<ValueGate> gate_;
  /// What pixels add: linear over the place of a cell in the law, with the same noise for all.
  struct {
    ShapeErrors middle;
    Eigen::Matrix<double, feature_count, varying> slope = Eigen::Matrix<double, feature_count, varying>::Zero();
  } pixels_;
};

}  // namespace rheocyte
