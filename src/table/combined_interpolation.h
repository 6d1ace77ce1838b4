// Stiffness and shape of a combined cell anywhere between the branches of its table, with exact derivatives.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <utility>
#include <vector>

#include "table/axis_polynomials.h"
#include "table/cell_coordinates.h"
#include "table/combined_table.h"

namespace rheocyte {

/// Rows of what is interpolated: ln(S / kPa), ln(area / um2), Lambda1 / Lambda2, the modes and the deformation.
inline constexpr int log_stiffness_row = 0, log_area_row = 1, moment_ratio_row = 2, first_mode_row = 3,
                     deformation_row = first_mode_row + mode_count, row_count = deformation_row + 1;

/// Of a feature of the shape (ShapeFeature).
constexpr int row_of(int feature) {
  static_assert(moment_ratio_row == int(ShapeFeature::moment_ratio) && first_mode_row == int(ShapeFeature::first_mode));
  switch (feature) {
    case int(ShapeFeature::area_um2): return log_area_row;
    case int(ShapeFeature::deformation): return deformation_row;
    default: return feature;
  }
}

struct CombinedState {
  Eigen::Matrix<double, row_count, 1> value;
  Eigen::Matrix<double, row_count, coordinate_count> gradient;
  bool inside = false;  ///< between branches that reach this progress; else it is continued from the nearest ones
};

/// Progress of a cell of 1 kPa in a table of elongated cells: the third mode of the stiffest cell that no axial tension
/// elongates, times its stiffness, to which this mode is inversely proportional. NaN without such a cell.
double mode_3_of_unit(const CombinedTable& table, SweepPoint place);

/// Range of the coordinates; the greatest progress is that of the branch that goes farthest.
struct CellBox {
  CellCoordinates least, greatest;
};

/// How much of a branch is in a state.
struct BranchWeight {
  int branch = 0;  ///< of CombinedTable::branches
  double weight = 0;
  double stiffness_kPa = 0;  ///< of the branch at the state's progress
};

class CellLine;

/// Cubics along the branches in ln of the progress, of quantities that hardly vary there; between the branches
/// polynomials through up to four radii, four fractions, four tensions of the cortex and four axial ratios. Where a
/// branch ends it goes straight on, and farther and farther beyond its end it counts less and less: nothing jumps
/// there.
class CombinedInterpolation {
 public:
  /// At least two radii, the same in all sheets; UserError otherwise.
  explicit CombinedInterpolation(const CombinedTable& table);

  CombinedState at(const CellCoordinates& cell) const;
  /// The values alone, in half of the time.
  Eigen::Matrix<double, row_count, 1> values_at(const CellCoordinates& cell) const;
  /// All cells with these coordinates but the progress. The table must outlive it.
  CellLine line(const CellCoordinates& cell) const;
  /// The branches of which `at` makes a state, for whatever else is known of them at this progress or, of those that
  /// count little, at their ends before it; weights sum to one. Empty outside the table.
  std::vector<BranchWeight> weights(const CellCoordinates& cell) const;
  bool is_inside(const CellCoordinates& cell) const;
  /// The cell, its coordinates within their ranges; or the last one inside on the way there from a stiffer one.
  CellCoordinates nearest_inside(CellCoordinates cell) const;
  const TableSpec& spec() const { return spec_; }
  const CellBox& box() const { return box_; }
  const std::vector<double>& radii_um() const { return radii_; }
  const std::vector<double>& tension_ratios() const { return ratios_; }
  bool is_elongated() const { return axial_ratios_.size() > 1; }

 private:
  friend CellLine;
  /// As long as whole packets of the processor, without which Eigen takes one number at a time.
  static constexpr int padded_rows = (row_count + 3) / 4 * 4;
  using Row = Eigen::Matrix<double, padded_rows, 1>;
  /// Scaled values and slopes over ln of the progress.
  struct Curve {
    int branch = -1;      ///< of the table
    bool is_own = false;  ///< else there is none, and the curve is that of the nearest radius or fraction that has one
    struct Sample {
      Row value, slope;
    };
    std::vector<double> place;
    std::vector<Sample> samples;
    bool reaches(double log_progress) const {
      return is_own && log_progress >= place.front() && log_progress <= place.back();
    }
  };
  class OnCurve;
  struct CurveWeight {
    const Curve* curve;
    CellFunction weight;
  };
  struct CurveWeights {
    std::vector<CurveWeight> all;
    double last_progress;  ///< as far as weights are the same, if it is not before the cell's progress
  };
  /// Of the first so many rows.
  template <int rows>
  struct Sum {
    Eigen::Matrix<double, rows, 1> value = Eigen::Matrix<double, rows, 1>::Zero();
    Eigen::Matrix<double, rows, coordinate_count> gradient = Eigen::Matrix<double, rows, coordinate_count>::Zero();
  };

  /// The power of the progress with which a row grows at first; what is left varies little. Of the
  /// stiffness, that of one over the progress.
  double growth(int row) const;
  /// `progress_of_unit`: in a table of elongated cells the progress of a cell of 1 kPa.
  Curve curve_of(const CombinedBranch& branch, double progress_of_unit) const;
  Curve curve_at(const CombinedTable& table, const SweepPoint& place) const;
  void fill_gaps();
  /// A sheet has one tension of the cortex and one axial ratio.
  int sheet_of(int axial, int ratio) const { return axial * int(ratios_.size()) + ratio; }
  const Curve& curve(int sheet, int fraction, int radius) const;
  template <int rows>
  static Sum<rows> sum_at(double progress, const CurveWeights& weights);
  /// All curves of which a cell is a weighted sum. What a branch counts falls smoothly to nothing beyond its end.
  CurveWeights curve_weights(const CellCoordinates& cell) const;
  /// The progress at which branches end: of one, and linearly between two radii, then two fractions, then two tensions.
  CellFunction end(const Curve& branch) const;
  CellFunction end(int sheet, int fraction, const CellCoordinates& cell) const;
  CellFunction sheet_end(int sheet, const CellCoordinates& cell) const;
  CellFunction axial_end(int axial, const CellCoordinates& cell) const;
  bool reaches(int sheet, int fraction, const CellCoordinates& cell) const;
  /// With the two fractions beside the cell's; with the two tensions of the cortex, too.
  bool sheet_reaches(int sheet, const CellCoordinates& cell) const;
  bool axial_reaches(int axial, const CellCoordinates& cell) const;

  TableSpec spec_;
  std::vector<double> radii_, log_radii_, fractions_, ratios_, axial_ratios_;  ///< of the sheets; one axial ratio: zero
  std::vector<Curve> curves_;  ///< radius by radius, fraction by fraction, sheet by sheet
  CellBox box_;
};

/// Cells that differ in their progress alone: where one is sought among them, most have the same weights of branches.
class CellLine {
 public:
  CellLine(const CombinedInterpolation& table, const CellCoordinates& cell) : table_(table), cell_(cell) {}
  /// ln(S / kPa).
  CellFunction log_stiffness(double progress);
  CombinedState at(double progress);

 private:
  void go_to(double progress);

  const CombinedInterpolation& table_;
  CellCoordinates cell_;
  CombinedInterpolation::CurveWeights weights_{{}, -HUGE_VAL};
};

}  // namespace rheocyte
