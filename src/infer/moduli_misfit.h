// By how much the features of a cell of a combined table miss those of a measured one, in standard errors.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "infer/bulk_cortex_fit.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// Ranges of the coordinates; one where there is none.
CellCoordinates widths(const CellBox& box);

/// Residuals of the chosen features, over the free coordinates. Behind them stand what it costs to leave the table,
/// and, where cells are elongated, what is known of the tension. There ln of the stiffness stands for the progress: the
/// tension over it then is a known number, where in the coordinates of the table a known tension is a bent valley, so
/// narrow that no minimiser gets along it.
class ModuliMisfit {
 public:
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, coordinate_count>;

  enum class TensionIs { known, fitted };

  /// Shape and tension are those in the table's channel and flow. Table and features must outlive it.
  ModuliMisfit(const CombinedInterpolation& table, MeasuredShape shape, std::span<const int> features,
               const AxialTension& tension, TensionIs tension_is);

  bool is_usable() const { return measured_.allFinite() && whitening_.size() > 0; }
  const MeasuredShape& shape() const { return shape_; }

  /// The coordinates that are fitted, the progress among them; the others stay as in `cell`, and the axial ratio
  /// follows a known tension.
  void set_free(std::vector<int> free, const CellCoordinates& cell);
  /// Those of the cell.
  Eigen::VectorXd parameters() const;
  CellCoordinates cell_at(const Eigen::VectorXd& parameters) const { return place(parameters).cell; }

  /// With their slopes by the parameters, where they are requested.
  Eigen::VectorXd residuals(const Eigen::VectorXd& parameters, Eigen::MatrixXd* slopes = nullptr) const;

  /// What the features and the tension tell of a cell, without the fence: J^T J.
  Eigen::Matrix<double, coordinate_count, coordinate_count> information(const CellCoordinates& cell) const;

 private:
  struct Place {
    CellCoordinates cell;
    CombinedState state;
    Eigen::Matrix<double, coordinate_count, Eigen::Dynamic> by_parameters;
  };
  Place place(const Eigen::VectorXd& parameters) const;
  Eigen::Index progress_parameter() const { return std::ranges::find(free_, x_progress) - free_.begin(); }
  /// Moves the progress there, from where the last cell lets expect it; the state.
  CombinedState meet_stiffness(double log_stiffness, CellCoordinates& cell) const;
  Eigen::VectorXd evaluate(const CellCoordinates& cell, const CombinedState& state, Jacobian& jacobian) const;

  struct Feature {
    double value;
    CellCoordinates gradient;
  };
  Feature feature(int number, const CellCoordinates& cell, const CombinedState& state) const;

  const CombinedInterpolation& table_;
  MeasuredShape shape_;
  std::span<const int> features_;
  AxialTension tension_;
  bool follows_tension_;
  Eigen::VectorXd measured_;
  Eigen::MatrixXd whitening_;
  std::vector<int> free_;
  CellCoordinates cell_ = CellCoordinates::Zero();
  struct Last {
    CellCoordinates cell;
    CombinedState state;
  };
  mutable Last last_;  ///< where the next search begins, in tables of elongated cells
};

}  // namespace rheocyte
