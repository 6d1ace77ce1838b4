// The estimates of a block of events, and what there is of them.
#pragma once
#include <optional>
#include <span>

#include "extract/elongation_values.h"
#include "infer/elongated_solids.h"
#include "infer/modulus_state.h"
#include "infer/shape_excess.h"
#include "measurement/contour_features.h"
#include "shape/outline_tilt.h"

namespace rheocyte {

/// What a block of events has to say, all equally long.
struct EventBlock {
  std::span<const double> area_um2, deformation, viscosity_mPas, young_modulus_kPa;
  std::span<const double> standard_error_kPa;  ///< empty if unknown
  std::span<const ModulusState> state;
  std::span<const ShapeExcess> shape;  ///< empty if nothing is known of the shapes
  std::span<const double> mode_3;      ///< empty without contours and masks
  ElongationBlock elongation;
  std::span<const ContourFeatures> outlines;  ///< empty unless they are measured, too
  std::span<const OutlineTilt> tilt;          ///< empty without contours and masks
  /// Effective moduli of cells under the axial tension of the recording; empty where there are none.
  std::span<const double> effective_modulus_kPa, effective_error_kPa;
  std::span<const ModulusState> effective_state;
};

/// What there is beside area, deformation, viscosity, Young's modulus and its state.
struct EventKnowledge {
  bool errors = false;     ///< of a table that has them
  bool shapes = false;     ///< against those of the table
  bool asymmetry = false;  ///< of contours or masks
  std::optional<ElongatedBy> elongated_by = {};
  bool effective = false;  ///< moduli of cells with a cortex under the axial tension of the recording
};

}  // namespace rheocyte
