// Stiffness and shape of a combined cell anywhere between the branches of its table, with exact derivatives.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "table/combined_table.h"

namespace rheocyte {

/// The coordinates of a cell. The deformation is one of them, not the stiffness: all branches reach the same
/// deformations and turn back at none, and states of equal deformation change least from branch to branch.
enum class CellCoordinate { log_radius, cortex_share, log_deformation, tension_ratio, count };
inline constexpr int coordinate_count = int(CellCoordinate::count);
using CellCoordinates = Eigen::Matrix<double, coordinate_count, 1>;

/// Columns of what is interpolated: ln(S / kPa), ln(area / um2), Lambda1 / Lambda2 and the modes.
inline constexpr int log_stiffness_row = 0, log_area_row = 1, moment_ratio_row = 2, first_mode_row = 3,
                     row_count = first_mode_row + mode_count;

struct CombinedState {
  Eigen::Matrix<double, row_count, 1> value;
  Eigen::Matrix<double, row_count, coordinate_count> gradient;
  bool inside = false;  ///< between branches that reach this deformation; else it is continued from the nearest ones
};

/// Range of the coordinates; the greatest deformation is that of the branch that goes farthest.
struct CellBox {
  CellCoordinates least, greatest;
};

/// How much of a branch is in a state.
struct BranchWeight {
  int branch = 0;  ///< of CombinedTable::branches
  double weight = 0;
};

/// Cubics along the branches in ln d, of quantities that hardly vary there; between the branches polynomials through up
/// to four radii, four shares, and all tensions.
class CombinedInterpolation {
 public:
  /// At least two radii and two shares, the same radii in all sheets; UserError otherwise.
  explicit CombinedInterpolation(const CombinedTable& table);

  CombinedState at(const CellCoordinates& cell) const;
  /// The branches of which `at` makes a state, for whatever else is known of them at this deformation, which all of
  /// them reach; weights sum to one. Empty outside the table.
  std::vector<BranchWeight> weights(const CellCoordinates& cell) const;
  const CellBox& box() const { return box_; }
  const std::vector<double>& radii_um() const { return radii_; }
  const std::vector<double>& tension_ratios() const { return ratios_; }

 private:
  using Row = Eigen::Matrix<double, row_count, 1>;
  /// Scaled values and slopes over ln d.
  struct Curve {
    int branch = -1;  ///< of the table; -1: none
    std::vector<double> log_d;
    std::vector<Row> value, slope;
    bool reaches(double log_deformation) const {
      return !log_d.empty() && log_deformation >= log_d.front() && log_deformation <= log_d.back();
    }
  };
  struct Sum;

  static Curve curve_of(const CombinedBranch& branch);
  const Curve& curve(int ratio, int share, int radius) const;
  Sum over_shares(int ratio, const CellCoordinates& cell) const;
  Sum over_radii(int ratio, int share, const CellCoordinates& cell) const;
  bool reaches(int ratio, int share, double log_radius, double log_deformation) const;
  bool is_inside(const CellCoordinates& cell) const;

  std::vector<double> radii_, log_radii_, shares_, ratios_;  ///< of the sheets
  std::vector<Curve> curves_;                                ///< radius by radius, share by share, ratio by ratio
  CellBox box_;
};

}  // namespace rheocyte
