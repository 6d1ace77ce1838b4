// Moduli of bulk and cortex of one cell, and what they are worth.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>

#include "numeric/no_value.h"
#include "table/cell_coordinates.h"

namespace rheocyte {

enum class Modulus { young, cortex, tension, count };
inline constexpr int modulus_count = int(Modulus::count);

enum class ModuliStatus {
  no_data,         ///< a feature, its error or a condition of the flow is not a number
  resolved,        ///< every modulus that is asked for is known to better than a factor of two
  not_told_apart,  ///< one of them is not, though the stiffness as a whole may be
  outside_table,   ///< no cell of the table has such a shape
  poor_fit,        ///< the nearest cell of the table differs from the shape by more than the errors allow
  gated,           ///< outside the limits that the user has set; nothing was fitted
  cut,             ///< the outline touches the edge of the picture: it is not that of the whole cell
  count
};
inline constexpr int moduli_status_count = int(ModuliStatus::count);
std::string_view name_of(ModuliStatus status);

struct ModuliEstimate {
  ModuliStatus status = ModuliStatus::no_data;
  /// Young's modulus (kPa), E2D (mN/m), tension (mN/m), and their covariance.
  Eigen::Vector3d modulus = Eigen::Vector3d::Constant(no_value);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Constant(no_value);
  std::array<bool, modulus_count> is_known{};  ///< standard error below `max_relative_error`
  double stiffness_kPa = no_value,
         stiffness_error_kPa = stiffness_kPa;                                       ///< E + E2D / r0
  double effective_modulus_kPa = no_value, effective_modulus_error_kPa = no_value;  ///< analytic/effective_modulus.h
  double axial_tension_Pa = no_value, axial_tension_error_Pa = no_value;  ///< of the liquid; 0 in tables of round cells
  CellCoordinates cell = CellCoordinates::Zero();                         ///< in the table's channel
  double chi_squared = no_value;
  int freedom = 0;
  double section_factor = 1;  ///< c_3 over that of such a cell in the tube, where the channel is square

  double value(Modulus m) const { return modulus(int(m)); }
  double error(Modulus m) const;
};
/// 90 % of the estimates lie between half and twice the value.
inline constexpr double max_relative_error = 0.42;

/// One plain sentence for the user.
std::string sentence(const ModuliEstimate& estimate);

}  // namespace rheocyte
