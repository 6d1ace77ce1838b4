// `rheocyte analytic table` and `lines`: the analytical model as text files for dclab.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/analytic_conditions.h"

namespace rheocyte {

/// Conditions and points of a table or of isoelasticity lines, solid cells only. Empty: the defaults, which scale with
/// the channel and the flow.
struct AnalyticTableInput {
  AnalyticConditions conditions;
  std::optional<double> min_radius_um, max_radius_um;
  int radii = 100;
  std::optional<double> min_modulus_kPa, max_modulus_kPa;
  int moduli = 60;
  std::vector<double> levels_kPa;  ///< of lines, instead of the range of moduli
  double max_deformation = max_solid_deformation;
  std::string identifier;
};

struct TextFile {
  std::string name, content;
  int rows = 0;
};

/// Look-up table (area_um, deform, emodulus) in dclab's format: radii by equal steps of r0^2, moduli by equal steps of
/// E^(-1/2). UserError for ranges that do not fit, or if no row remains.
TextFile analytic_table(const AnalyticTableInput&);

/// Isoelasticity lines in dclab's format. UserError as above.
TextFile analytic_lines(const AnalyticTableInput&);

}  // namespace rheocyte
