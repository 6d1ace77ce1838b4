// The cell that has the median area, deformation and inertia ratio of a recording's events: its effective modulus is
// reported of cells that the flow alone does not make so long (docs/theory-extract.md, sec. "The effective modulus").
#pragma once
#include <cstddef>
#include <tuple>
#include <vector>

#include "extract/median.h"
#include "infer/proportioned_cells.h"
#include "numeric/censored_median.h"
#include "numeric/no_value.h"

namespace rheocyte {

/// Area (um2), deformation and inertia ratio of events as measured, of all that count: what has no modulus counts, too.
struct EventFigures {
  std::vector<double> area_um2, deformation, inertia_ratio;
  bool has_ratios = true;  ///< else inertia ratios are NaN

  /// An event, unless it is a red cell or lacks a number.
  void take(double event_area_um2, double event_deformation, double event_inertia_ratio);
};

/// Where the median cell lies in the table; ambiguous: cells of different stiffness there have such medians.
enum class EffectivePlace { unknown, inside, softer, longer, stiffer, other_size, ambiguous };

struct EffectiveCell {
  std::size_t events = 0;
  bool is_by_ratios = true;  ///< else by area and deformation, under an axial tension that is given
  Section section = Section::square;
  EffectivePlace place = EffectivePlace::unknown;
  Median effective_kPa;  ///< modulus of the homogeneous solid that a small axial tension elongates alike
  Median stiffness_kPa;  ///< E + E2D / r0
  Median young_kPa, cortex_mN_per_m, tension_mN_per_m;  ///< of bulk and cortex, in the table's proportions
  Median axial_tension_Pa;                              ///< of the liquid
  double radius_um = no_value;                          ///< at rest
  double spread = no_value;  ///< of ln of the effective modulus between cells, without the noise of their pictures
  double wall_stress_Pa = no_value, viscosity_mPas = no_value;
  double softest_kPa = no_value;     ///< effective modulus at the end of the table, of a softer cell
  double over_other_law = no_value;  ///< the effective modulus over that by the other law of the cortex
  /// Under a given tension: what the inertia ratios determine in its place, if there are any.
  double by_ratios_kPa = no_value, by_ratios_tension_Pa = no_value;
  /// Of the median cell of the third of the events with the largest areas over that of the third with the smallest, and
  /// their standard errors by scatter: the model has one axial tension for all sizes.
  Median large_over_small_modulus, large_over_small_tension;
  CensoredMedian events_kPa;  ///< of the effective moduli of all events under this axial tension
  bool is_found() const { return place == EffectivePlace::inside; }

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.events, s.is_by_ratios, s.section, s.place, s.effective_kPa, s.stiffness_kPa, s.young_kPa,
                    s.cortex_mN_per_m, s.tension_mN_per_m, s.axial_tension_Pa, s.radius_um, s.spread, s.wall_stress_Pa,
                    s.viscosity_mPas, s.softest_kPa, s.over_other_law, s.by_ratios_kPa, s.by_ratios_tension_Pa,
                    s.large_over_small_modulus, s.large_over_small_tension, s.events_kPa);
  }
};

/// Fewer events have none.
inline constexpr std::size_t min_events_of_effective_cell = 20;

/// Its errors in common are those of pixels, section and table. An axial tension of the liquid that is known takes the
/// place of the inertia ratios. Unknown for too few events, without a table, and where neither of the two is known.
EffectiveCell effective_cell(const ProportionedTables& tables, const EventFigures& events, const Sight& sight,
                             double pixel_size_um, const AxialTension& tension = AxialTension::unknown());

/// What the model adds to the errors in common: inertia, height, and the proportions and the law of the cortex. Of
/// cells whose outlines show a cortex the proportions are better known.
void add_errors_of_model(double reynolds, bool is_cortex_seen, EffectiveCell& cell);

}  // namespace rheocyte
