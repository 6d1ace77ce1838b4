#include "extract/shape_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "events/plausibility.h"
#include "extract/growth_of_asymmetry.h"
#include "extract/recommendation.h"

namespace rheocyte {

namespace {

std::string changes_text(const char* name, const Trend& trend) {
  return fmt::format("{} {:+.2g} +- {:.2g} of {:.3g}", name, trend.change, trend.error, trend.median);
}

/// Empty where it does not grow.
std::string centring_or_creep(const ShapeVerdict& v) {
  const GrowthOfAsymmetry g = growth_of_asymmetry(v);
  if (g.kind == Growth::none) return {};
  const std::string change = fmt::format("c4 changes by {:+.2g} +- {:.1g}, {:+.2g} if cells approach the axis",
                                         g.change_of_mode_4, v.mode_4_trend.error, g.expected);
  if (g.kind == Growth::of_creeping_cells)
    return fmt::format("; downstream c3 grows, as of cells that creep, not of cells that approach the axis ({})",
                       change);
  if (!v.beside_axis.is_centring())
    return fmt::format("; downstream c3 grows, as of cells that approach the axis ({}), but pos_y does not show it",
                       change);
  return fmt::format(
      "; downstream c3 grows, as of cells that still approach the axis, not of cells that creep ({}; "
      "it takes {:.2g} um2 of their squared distance from the axis, height included)",
      change, -g.growth / mode_3_per_um2);
}

/// Which cells they are, and what that means for the moduli.
std::string text_of(const FittingTable& table) {
  const double percent = 100 * (table.modulus_over_its - 1);
  std::string moduli =
      std::abs(percent) < 0.5 || !std::isfinite(percent)
          ? std::string("take the table")
          : fmt::format(
                "of such cells the Young's moduli from deformation given here are {:.1f} % too {}, take the table",
                std::abs(percent), percent > 0 ? "high" : "low");
  return fmt::format("those of {} (expected {:.3g}, excess {:.3f} +- {:.3f}); {} {}.", table.cells,
                     table.expected_inertia_ratio, table.excess.value, table.excess.error, moduli, table.identifier);
}

/// Of cells that are longer or rounder than those of all tables.
std::string text_on_strangers(const ShapeVerdict& v, const std::string& cells, const std::string& numbers) {
  const bool is_rounder = v.excess.value < 0;
  // Where both moduli of elongated cells are known the asymmetry must give more.
  const std::string_view meaning =
      is_rounder ? ", as cells of another law or with a cortex may be; Young's moduli from deformation are not theirs, "
                   "see docs/real-cells.md."
      : v.effective.is_found() ? "; Young's moduli from deformation are not theirs, see docs/real-cells.md."
      : v.modulus_ratio >= 1
          ? "; yet Young's moduli from deformation are not below those of elongated cells: are pixel "
            "size and channel right?"
          : "; Young's moduli from deformation are too low, see docs/real-cells.md.";
  return fmt::format("the cells are {} than {} and than the cells of any other table of the program ({}){}",
                     is_rounder ? "rounder" : "elongated along the flow more", cells, numbers, meaning);
}

std::string elongated_text(const ShapeVerdict& v) {
  return fmt::format(
      "E by {} of {} event{} as cells elongated by the liquid: median {} kPa (quartiles {:.4g} to {:.4g}); elongation "
      "{}, axial tension {} Pa{}",
      v.elongated_by == ElongatedBy::modes ? "the outlines" : "deformation and inertia ratio", v.with_elongation,
      v.with_elongation == 1 ? "" : "s", median_text(v.elongated_kPa), v.elongated_kPa.first_quartile,
      v.elongated_kPa.third_quartile, text_with_errors(v.elongation), text_with_errors(v.axial_tension_Pa),
      std::isfinite(v.elongation.common_error) ? " (errors by the scatter of the events, and by pixels and table)"
                                               : "");
}

}  // namespace

std::string text_with_errors(const Median& median, int digits) {
  std::string text = fmt::format("{:.{}g}", median.value, digits);
  for (const double error : {median.error, median.common_error})
    if (std::isfinite(error)) text += fmt::format(" +- {:.2g}", error);
  return text;
}

std::string ShapeVerdict::text() const {
  const std::string law = model.empty() ? "" : ", " + model, cells = model.empty() ? "the cells of the table" : model;
  const std::string numbers =
      fmt::format("inertia ratio {:.4g}, expected {:.4g}, excess {:.3f} +- {:.3f}; {:.1f} % of {} events flagged",
                  inertia_ratio, expected_inertia_ratio, excess.value, excess.error, elongated_percent(), judged);
  switch (fit()) {
    case Fit::unknown:
      if (judged == 0 && !missing.empty()) return missing;
      return fmt::format("{} too few to say whether the shapes are those of the model.",
                         judged == 1 ? "1 event is" : fmt::format("{} events are", judged));
    case Fit::model: return fmt::format("the shapes are those of the model{} ({}).", law, numbers);
    case Fit::other_table:
      return fmt::format("the shapes are not those of {} ({}) but {}", cells, numbers, text_of(other));
    case Fit::doubtful:
      return fmt::format("whether the shapes are those of the model{} is doubtful ({}).", law, numbers);
    case Fit::rounder:
    case Fit::elongated: break;
  }
  return text_on_strangers(*this, cells, numbers);
}

std::string ShapeVerdict::trend_text() const {
  if (judged == 0) return {};
  if (!std::isfinite(seen_um)) return "no pos_x: whether the shapes still change along the channel is unknown.";
  if (seen_um < least_length_of_trend_um)
    return fmt::format("the cells are seen at one place ({:.2g} um): whether they still change is unknown.", seen_um);
  if (judged < fewest_for_a_trend || !std::isfinite(deformation_trend.change))
    return fmt::format("too few events for a trend along the channel ({}).", judged);
  std::string changes =
      changes_text("inertia ratio", inertia_ratio_trend) + ", " + changes_text("deformation", deformation_trend);
  if (std::isfinite(asymmetry_trend.change)) changes += ", " + changes_text("c3", asymmetry_trend);
  const bool is_changing =
      inertia_ratio_trend.is_changing() || deformation_trend.is_changing() || asymmetry_trend.is_changing();
  return fmt::format("the shapes are {} over {:.0f} um along x ({}){}.", is_changing ? "still changing" : "settled",
                     seen_um, changes, centring_or_creep(*this));
}

std::vector<std::string> shape_lines(const ShapeVerdict& v) {
  std::vector<std::string> lines;
  if (!v.made_of.empty()) lines.push_back(v.made_of);
  if (v.judged > 0) lines.insert(lines.end(), {v.text(), v.trend_text()});
  for (const std::string& sentence : {v.beside_axis.turn_text(), v.beside_axis.centring_text()})
    if (!sentence.empty()) lines.push_back(sentence);
  if (!v.missing.empty()) lines.push_back(v.missing);
  if (v.with_elongation > 0) lines.push_back(elongated_text(v));
  if (const auto text = recommendation_text(recommendation(v), v); !text.empty()) lines.push_back(text);
  if (v.red_cells > 0)
    lines.push_back(fmt::format(
        "{} as small and long as red cells (inertia ratio above {:g}, area below {:g} um2); {}.",
        v.red_cells == 1 ? "1 event is" : fmt::format("{} events are", v.red_cells), min_inertia_ratio_of_red_cells,
        max_area_of_red_cells_um2, v.red_cells == 1 ? "it does not count here" : "they do not count here"));
  return lines;
}

}  // namespace rheocyte
