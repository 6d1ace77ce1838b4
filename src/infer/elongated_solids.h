// Young's modulus of solids that are elongated along the flow, from area and two numbers of the outline
// (docs/theory-extract.md, sec. "elongated cells").
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "infer/modulus_map.h"
#include "table/elongated_table.h"

namespace rheocyte {

/// What an elongated cell is described by beside its area: the modes c_2 and c_3 of its outline, or where there is no
/// outline its deformation and inertia ratio.
enum class ElongatedBy { modes, inertia };

/// One value per event, spans of one length, as measured: c_2 and c_3 of a cell that moves towards +x, or the inertia
/// ratio and the deformation. Of the next modes, c_4 and c_5, depends what pixels do to the first ones.
struct ElongatedShapes {
  ElongatedBy by;
  std::span<const double> first, second;
  std::span<const double> mode_4 = {}, mode_5 = {};  ///< by modes and through pixels
};

/// One value per event, spans of one length; NaN without a modulus.
struct ElongatedEstimates {
  EstimatedModuli moduli;
  std::span<double> elongation;              ///< length over width that the tension alone gives the cell at rest
  std::span<double> elongation_error;        ///< standard error
  std::span<double> axial_tension_Pa;        ///< of the liquid along the flow, that would elongate it so
  std::span<double> axial_tension_error_Pa;  ///< standard error
  std::span<ElongatedCell> cell;             ///< in the table's coordinates
};

class ElongatedSolids {
 public:
  explicit ElongatedSolids(ElongatedContent content) : table_(std::move(content)) {}

  const TableOrigin& origin() const { return table_.origin(); }
  const ElongatedTable& table() const { return table_; }

  /// Of the events' areas and viscosities and the shapes, less what pixels do. The error is that of pixels and table.
  void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events, const ElongatedShapes& shapes,
                const ElongatedEstimates& estimates) const;

  /// The cell of the table with these numbers, without pixels and in the table's channel: ln(area / um2) and the two
  /// numbers of its shape as in ElongatedShapes.
  struct Found {
    ElongatedCell cell;
    ElongatedState state;
    ModulusState reason = ModulusState::valid;  ///< if it is another one the rest means nothing
    Eigen::Matrix3d slopes;                     ///< of the three numbers by the coordinates
  };
  Found find(const Eigen::Vector3d& seen, ElongatedBy by) const;

 private:
  ElongatedTable table_;
};

}  // namespace rheocyte
