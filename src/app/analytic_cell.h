// `rheocyte analytic cell`: one cell of the analytical model in physical units.
#pragma once
#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "app/analytic_conditions.h"
#include "case/physical_scales.h"

namespace rheocyte {

/// What is known of the cell: a solid has a Young's modulus, a shell the modulus and the tension of its cortex.
struct AnalyticCellInput {
  AnalyticConditions conditions;
  double radius_um = 0;
  std::optional<double> young_modulus_kPa, cortex_modulus_mN_per_m;
  double tension_ratio = 0;  ///< gamma / E2D of a shell
};

struct AnalyticCell {
  AnalyticCellInput input;
  Scales scales;
  double capillary_number = 0;  ///< eta Q / (R^3 E) of a solid, eta Q / (R^2 E2D) of a shell
  CellInTube cell;
  double strain = 0;
  SmallDeformation state;

  bool is_solid() const { return input.young_modulus_kPa.has_value(); }
  /// Empty, or a sentence about the limits of the model that this cell exceeds.
  std::string remark() const;
};

/// UserError if the radius does not fit into the tube or the cell is so soft that its linear shape has no inside.
AnalyticCell analytic_cell(const AnalyticCellInput&);

/// Lines for the user.
std::string summary(const AnalyticCell&);

/// Keys are those of result.json where they mean the same.
nlohmann::ordered_json to_json(const AnalyticCell&);

/// How a file of a contour begins.
inline constexpr std::string_view contour_mark = "x_um,r_um\n";

/// Meridian (x, r) from the front to the rear pole, at equal angles of the undeformed sphere; x counts from its centre.
Eigen::MatrixX2d contour_um(const AnalyticCell&);
/// As text, the same columns as contour.csv of `rheocyte solve`.
std::string contour_text(const AnalyticCell&);

}  // namespace rheocyte
