// Moduli of bulk and cortex, and the tension, of one cell from its shape, by least squares on a combined table
// (docs/theory-extract.md, sec. "several moduli").
#pragma once
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "case/channel_flow.h"
#include "infer/cells_at_rest.h"
#include "infer/moduli_estimate.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// What is known of the tension of the liquid along the flow by which cells are elongated (docs/theory.md,
/// eq:axial-tension). Only tables of elongated cells have one.
struct AxialTension {
  double value_Pa = 0;
  double error_Pa = 0;  ///< standard error; infinite: nothing is known, and it is fitted with each cell
  static AxialTension unknown() { return {0, HUGE_VAL}; }
  /// Exactly, if it is given.
  static AxialTension given(const std::optional<double>& Pa) { return Pa ? AxialTension{*Pa, 0} : unknown(); }
  bool is_known() const { return std::isfinite(error_Pa); }
};

struct MeasuredShape {
  ShapeVector features;  ///< with ln(volume / um3) in place of ln(area) if the size is a volume
  ShapeErrors errors;    ///< the bias is subtracted
  bool size_is_volume = false;
};

struct FitOptions {
  std::vector<int> features;  ///< numbers of ShapeFeature, those of the modes from ShapeFeature::first_mode on
  bool free_tension = false;  ///< the tension ratio is fitted, too, if the table has several
  double tension_ratio = 0;   ///< else this one
};
/// Area, deformation, Lambda1 / Lambda2: the two measures of figure 9 of Mokbel et al. 2017 and a size.
std::vector<int> features_of_figure();
/// Area and the modes up to `last`, 2 <= last <= max_mode: the whole contour.
std::vector<int> features_of_contour(int last = 6);

class ModuliMisfit;

/// The table's interpolation must outlive it.
class BulkCortexFit {
 public:
  BulkCortexFit(const CombinedInterpolation& table, const ChannelFlow& simulated, FitOptions options);

  /// Of the cell that fits best of all, or on the way down from a cell.
  ModuliEstimate fit(const MeasuredShape& shape, const ChannelFlow& flow, const AxialTension& tension = {},
                     const CellCoordinates* start = nullptr) const;

  /// A cell of the table, and how far its features are off.
  struct Candidate {
    CellCoordinates cell;
    double chi_squared;
  };
  /// The nearest one: of all, or on the way down from a cell. Nothing if a feature or its error is not a number.
  std::optional<Candidate> nearest(const MeasuredShape& shape, const ChannelFlow& flow, const AxialTension& tension,
                                   const CellCoordinates* start = nullptr) const;
  /// Of a cell of the table that is seen in a flow.
  double axial_tension_Pa(const CellCoordinates& cell, const ChannelFlow& flow) const;
  ShapeVector shape_of(const CellCoordinates& cell, const ChannelFlow& flow) const;
  const CombinedInterpolation& table() const { return table_; }
  const ChannelFlow& simulated() const { return simulated_; }  ///< the table's channel
  const CellsAtRest& at_rest() const { return at_rest_; }      ///< in that channel
  const std::vector<int>& features() const { return options_.features; }
  /// Features less parameters, the axial tension being known.
  int freedom() const;

 private:
  enum class Fraction { fitted, held };
  using Covariance = Eigen::Matrix<double, coordinate_count, coordinate_count>;
  /// In the table's channel and flow.
  ModuliMisfit misfit(const MeasuredShape& shape, const ChannelFlow& flow, const AxialTension& tension) const;
  double middle_ratio() const;  ///< of the table's tensions
  /// Whether the table has cells of several fractions of the cortex.
  bool has_free_fraction() const;
  CellCoordinates start_for(const MeasuredShape& shape) const;
  /// The start at which the features fit best of some whose stiffnesses differ, with the tension that is known.
  static CellCoordinates with_best_stiffness(ModuliMisfit& misfit, const CellCoordinates& start);
  Candidate nearest(ModuliMisfit& misfit, const CellCoordinates* start = nullptr) const;
  Candidate minimum_from(ModuliMisfit& misfit, const CellCoordinates& start, Fraction fraction) const;
  std::vector<Candidate> profile(ModuliMisfit& misfit, const Candidate& best) const;
  Covariance covariance_at(const ModuliMisfit& misfit, const CellCoordinates& cell) const;
  /// Where another cell fits as well and differs by more than a factor of two, a modulus is not known.
  void forget_what_others_deny(std::span<const Candidate> others, ModuliEstimate& estimate) const;
  ModuliEstimate estimate_of(ModuliMisfit& misfit, const Candidate& best) const;

  const CombinedInterpolation& table_;
  CellsAtRest at_rest_;
  ChannelFlow simulated_;
  FitOptions options_;
};

}  // namespace rheocyte
