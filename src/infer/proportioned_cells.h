// Cells whose bulk, cortex and tension of the cortex stand in fixed proportions to each other. Area, deformation and
// inertia ratio determine the size, the stiffness and the axial tension of the liquid, and so the effective modulus,
// which hardly depends on the proportions (docs/theory-extract.md, sec. "The effective modulus").
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "infer/bulk_cortex_fit.h"
#include "infer/rendered_errors.h"
#include "infer/square_law.h"
#include "table/combined_interpolation.h"

namespace rheocyte {

/// ln(area / um2), deformation and Lambda1 / Lambda2 of outlines in pixels.
struct SeenFigure {
  Eigen::Vector3d value;
  Eigen::Matrix3d covariance;  ///< by the scatter of the events
};

/// Estimates of one cell, which differ in their errors.
struct ProportionedEstimate {
  ModuliEstimate by_scatter;  ///< of the events
  ModuliEstimate in_common;   ///< of all events: by the pixels, the section of the channel and the table
  ModuliEstimate of_picture;  ///< of one event by its pixels
  /// Whether other cells of the table, of another stiffness, have the same area, deformation and inertia ratio: very
  /// long ones, of which the deformation does not determine the asymmetry.
  bool is_ambiguous = false;
  /// Of the last cell of the table with this size and axial tension over stiffness, where the cell is a softer one.
  double softest_kPa = no_value;
};

class ProportionedCells {
 public:
  /// Of an elongated combined table with one fraction and one tension; UserError otherwise.
  explicit ProportionedCells(const CombinedTable& table);
  ProportionedCells(const ProportionedCells&) = delete;
  ProportionedCells& operator=(const ProportionedCells&) = delete;

  /// The cell that is seen so; a pixel size of zero: without pixels. Where the axial tension of the liquid is known,
  /// Lambda1 / Lambda2 may be missing (NaN).
  ProportionedEstimate estimate(SeenFigure seen, const Sight& sight, double pixel_size_um,
                                const AxialTension& tension = AxialTension::unknown()) const;

  const CombinedInterpolation& table() const { return between_; }
  const ChannelFlow& simulated() const { return simulated_; }  ///< the table's channel
  /// Of a cell of the table, in the table's flow.
  double effective_modulus_kPa(const CellCoordinates& cell) const;
  /// What the section of the channel adds to the features of a cell of the table, on average.
  ShapeVector change_by_section(const CellCoordinates& cell, const Sight& sight) const;
  /// What pixels add to area, deformation and Lambda1 / Lambda2 of a smooth shape on average over all places on the
  /// camera; modes stay.
  ShapeVector mean_of_pixels(const ShapeVector& smooth, double pixel_size_um) const;
  /// Of a cell of the table, as it is seen without pixels.
  ShapeVector smooth_shape(const CellCoordinates& cell, const Sight& sight) const {
    return in_tube(cell, sight.flow) + change_by_section(cell, sight);
  }

 private:
  /// Of a cell of the table in the tube, without pixels.
  ShapeVector in_tube(const CellCoordinates& cell, const ChannelFlow& flow) const;
  /// Of a cell of the table with a shape that is seen.
  CellInSquare in_square(const CellCoordinates& cell, const ShapeVector& smooth, const Sight& sight) const;
  ShapeVector change_by_section(const CellCoordinates& cell, const ShapeVector& in_tube, const Sight& sight,
                                int rounds) const;
  /// What is added to the features of a cell of the table.
  struct Added {
    ShapeErrors by_square, by_pixels;
  };
  Added added(const CellCoordinates& cell, const Sight& sight, double pixel_size_um) const;
  ShapeErrors added_by_section(const CellCoordinates& cell, const ShapeVector& in_tube, const Sight& sight) const;
  /// Where fits from cells of other stiffness end, from the same size and under the same tension.
  std::vector<BulkCortexFit::Candidate> from_other_stiffnesses(const MeasuredShape& shape, const ChannelFlow& flow,
                                                               const AxialTension& tension,
                                                               const CellCoordinates& cell) const;
  /// The cell that is nearest, but one of the table rather than one beyond it, where the table is only continued.
  std::optional<BulkCortexFit::Candidate> nearest(const MeasuredShape& shape, const ChannelFlow& flow,
                                                  const AxialTension& tension, const CellCoordinates* start) const;
  bool has_others_alike(const MeasuredShape& shape, const ChannelFlow& flow, const AxialTension& tension,
                        const CellCoordinates& cell) const;

  CombinedInterpolation between_;
  ChannelFlow simulated_;
  BulkCortexFit fit_;
};

/// Tables of cells with a cortex in the proportions of HL60 cells; null without files.
struct ProportionedTables {
  const ProportionedCells* in_liquid = nullptr;  ///< in the liquid that is nearest to that of the recording
  /// In a Newtonian liquid, by a cortex with an energy per current area, as in_liquid, and per reference area: their
  /// ratio is what the law of the cortex changes.
  const ProportionedCells *by_current_area = nullptr, *by_reference_area = nullptr;
};

}  // namespace rheocyte
