// What a virtual cell looks like in the channel: the one interface between the populations and the models of shapes.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "table/table_spec.h"

namespace rheocyte {

/// A cell and the liquid round it; the channel and the flow rate are those of the recording.
struct VirtualCell {
  double radius_um = 0;  ///< of the sphere at rest
  double stiffness = 0;  ///< Young's modulus (kPa) of what has a bulk, modulus of the cortex (mN/m) of a shell
  double viscosity_mPas = 0;
  double cortex_modulus_mN_per_m = 0, tension_mN_per_m = 0;  ///< of a combined cell
  double axial_tension_Pa = 0;                               ///< of the liquid, along the flow
  double rest_aspect = 1;                                    ///< length over width where nothing acts
  double own_viscosity_mPas = 0, place_um = 0;  ///< of a cell on its way: inside it, behind the contraction
};

/// The stationary state of a cell, or that at its place, in um.
struct CellShape {
  Eigen::MatrixX2d meridian;  ///< points (x, r) from the front pole to the rear pole
  double area_um2 = 0;        ///< of the convex hull
  double deformation = 0;     ///< of the convex hull
  double volume_um3 = 0;
  double time_s = 0;  ///< of a cell on its way, since it started
};

/// Why a model has no shape for a cell.
enum class NoShape {
  too_small,
  too_large,
  too_stiff,
  too_soft,
  outside_picture,
  outside_sheets,
  outside_times,
  outside_tensions,
  outside_aspects,
  outside_places
};

inline constexpr std::array<std::string_view, 10> names_of_missing_shapes{"too small",
                                                                          "too large",
                                                                          "too stiff",
                                                                          "too soft",
                                                                          "outside the picture",
                                                                          "of a cortex or tension outside the table",
                                                                          "of a viscosity outside the table",
                                                                          "under an axial tension outside the table",
                                                                          "of a shape at rest outside the table",
                                                                          "at a place outside the table"};

class CellShapes {
 public:
  virtual ~CellShapes() = default;
  virtual std::variant<CellShape, NoShape> shape(const VirtualCell& cell) const = 0;
  /// By what it draws cells out; nothing if it does not.
  virtual std::optional<Elongation> elongation() const { return {}; }
  /// In one line, with its range.
  virtual std::string description() const = 0;
};

}  // namespace rheocyte
