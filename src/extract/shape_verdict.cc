#include "extract/shape_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "extract/common_errors.h"
#include "numeric/no_value.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr double of_the_model = 0.02, still_doubtful = 0.05;  // medians of the excess
constexpr std::size_t fewest_for_a_verdict = 5;               // events
constexpr double most_cut_off = 0.05;                         // of the events, at one end of a table

std::string changes_text(const char* name, const Trend& trend) {
  return fmt::format("{} {:+.2g} +- {:.2g} of {:.3g}", name, trend.change, trend.error, trend.median);
}

/// What explains an asymmetry that grows downstream.
enum class Growth { none, of_creeping_cells, of_centring_cells };
struct GrowthOfAsymmetry {
  Growth kind = Growth::none;
  double growth = 0, change_of_mode_4 = 0, expected = 0;  ///< of c_4 if cells approach the axis
};
// Of a cell that approaches the axis, with its cortex as those of HL60 have it (docs/real-cells.md).
constexpr double mode_3_per_um2 = -0.0146, mode_4_over_mode_3 = -0.007 / 0.0065;

GrowthOfAsymmetry growth_of(const ShapeVerdict& v) {
  GrowthOfAsymmetry g{.growth = v.direction * v.asymmetry_trend.change};
  if (!v.asymmetry_trend.is_changing() || !(g.growth > 0) || !std::isfinite(v.mode_4_trend.error)) return g;
  constexpr double sure = 2;
  g.change_of_mode_4 = v.direction * v.mode_4_trend.change;
  g.expected = mode_4_over_mode_3 * g.growth;
  const double error = std::hypot(v.mode_4_trend.error, mode_4_over_mode_3 * v.asymmetry_trend.error);
  const bool approaches = g.change_of_mode_4 < -sure * v.mode_4_trend.error &&
                          std::abs(g.change_of_mode_4 - g.expected) < sure * error + std::abs(g.expected) / 2;
  g.kind = approaches ? Growth::of_centring_cells : Growth::of_creeping_cells;
  return g;
}

/// Empty where it does not grow.
std::string centring_or_creep(const ShapeVerdict& v) {
  const GrowthOfAsymmetry g = growth_of(v);
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
      : v.modulus_ratio >= 1
          ? "; yet Young's moduli from deformation are not below those of elongated cells: are pixel "
            "size and channel right?"
          : "; Young's moduli from deformation are too low, see docs/real-cells.md.";
  return fmt::format("the cells are {} than {} and than the cells of any other table of the program ({}){}",
                     is_rounder ? "rounder" : "elongated along the flow more", cells, numbers, meaning);
}

std::string text_with_errors(const Median& median) {
  std::string text = fmt::format("{:.4g}", median.value);
  for (const double error : {median.error, median.common_error})
    if (std::isfinite(error)) text += fmt::format(" +- {:.2g}", error);
  return text;
}

std::string elongated_text(const ShapeVerdict& v) {
  return fmt::format(
      "E by {} of {} event{} as of cells that the liquid draws out: median {} kPa (quartiles {:.4g} to {:.4g}); "
      "elongation {}, axial tension {} Pa{}",
      v.elongated_by == ElongatedBy::modes ? "the outlines" : "deformation and inertia ratio", v.with_elongation,
      v.with_elongation == 1 ? "" : "s", median_text(v.elongated_kPa), v.elongated_kPa.first_quartile,
      v.elongated_kPa.third_quartile, text_with_errors(v.elongation), text_with_errors(v.axial_tension_Pa),
      std::isfinite(v.elongation.common_error) ? " (errors by the scatter of the events, and by pixels and table)"
                                               : "");
}

std::string cut_off_text(const ShapeVerdict& v) {
  const bool are_stiff = v.too_stiff > v.too_soft;
  return fmt::format(
      "{} of {} events are {} a modulus from area and deformation, whose median would be that of the {} ones",
      are_stiff ? v.too_stiff : v.too_soft, v.with_deformation + v.too_stiff + v.too_soft,
      are_stiff ? "too stiff for" : "too soft for", are_stiff ? "softer" : "stiffer");
}

/// With the errors that are known, and what they are.
std::string report_text(const Median& modulus, std::string_view from) {
  std::string_view meaning;
  if (std::isfinite(modulus.common_error))
    meaning =
        "; errors by the scatter of the events, and by pixels, table and inertia, which they share; those of "
        "viscosity, flow rate and pixel size come on top";
  else if (std::isfinite(modulus.error))
    meaning = "; the error is by the scatter of the events alone";
  return fmt::format("report E = {} kPa (median, {}{})", text_with_errors(modulus), from, meaning);
}

}  // namespace

double max_excess_of_the_model(const Median& excess) {
  return std::min(of_the_model + 2 * excess.error, still_doubtful);
}

Median median_with_error(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return {no_value, no_value};
  const CountedSample<double> sample(values);
  return {sample.quantile(0.5), error_of_median(sample)};
}

bool Trend::is_changing() const { return std::abs(change) > 3 * error && std::abs(change) > 0.05 * std::abs(median); }

double ShapeVerdict::elongated_percent() const {
  return judged == 0 ? no_value : 100 * static_cast<double>(elongated) / static_cast<double>(judged);
}

ShapeVerdict::Fit ShapeVerdict::fit() const {
  if (judged < fewest_for_a_verdict || !std::isfinite(excess.value)) return Fit::unknown;
  const double distance = std::abs(excess.value);
  if (distance < max_excess_of_the_model(excess)) return Fit::model;
  if (!other.identifier.empty()) return Fit::other_table;
  // Few events may lie off by chance.
  if (distance < std::max(still_doubtful, of_the_model + 2 * excess.error)) return Fit::doubtful;
  return excess.value < 0 ? Fit::rounder : Fit::elongated;
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

bool ShapeVerdict::has_cortex_shapes() const {
  // Pixels change both by less than that.
  constexpr double least = 0.01, deviations = 4;
  const auto differs = [&](const Median& excess) {
    return std::abs(excess.value) > std::max(least, deviations * excess.error);
  };
  return with_elongation >= fewest_for_a_verdict && (differs(cortex_mode_4) || differs(cortex_mode_5));
}

bool ShapeVerdict::is_cut_off() const {
  const double difference = std::abs(double(too_stiff) - double(too_soft));
  return difference > most_cut_off * double(with_deformation + too_stiff + too_soft);
}

bool ShapeVerdict::is_told_by_outlines() const {
  return elongated_by == ElongatedBy::modes && with_elongation >= fewest_for_a_verdict &&
         double(with_elongation) >= (1 - most_cut_off) * double(judged);
}

bool ShapeVerdict::is_contradicted() const {
  constexpr double least = 0.05, sure = 3;
  const Median& d = by_deformation_kPa;
  const double error =
      std::hypot(std::hypot(d.error, d.common_error) / d.value,
                 std::hypot(elongated_kPa.median_error / elongated_kPa.median, elongated_common_error));
  return is_told_by_outlines() && std::abs(std::log(d.value / elongated_kPa.median)) > std::max(least, sure * error);
}

bool ShapeVerdict::is_creeping() const {
  constexpr double most = 0.2;  // of c_3
  const GrowthOfAsymmetry g = growth_of(*this);
  return g.kind == Growth::of_creeping_cells && g.growth > most * std::abs(asymmetry_trend.median);
}

ShapeVerdict::Modulus ShapeVerdict::recommended() const {
  if (has_cortex_shapes() || is_creeping()) return Modulus::none;
  if (fit() == Fit::model || fit() == Fit::unknown) {
    if (is_cut_off()) return is_told_by_outlines() ? Modulus::elongated : Modulus::none;
    return is_contradicted() ? Modulus::elongated : Modulus::by_deformation;
  }
  return with_elongation < fewest_for_a_verdict ? Modulus::none : Modulus::elongated;
}

Median ShapeVerdict::recommended_kPa() const {
  switch (recommended()) {
    case Modulus::none: return {};
    case Modulus::by_deformation: return by_deformation_kPa;
    case Modulus::elongated: break;
  }
  const double of_shapes = fit() == Fit::model ? 0 : common_error_of_other_shapes;
  return {elongated_kPa.median, elongated_kPa.median_error,
          std::hypot(elongated_common_error, of_shapes) * elongated_kPa.median};
}

namespace {

std::string none_text(const ShapeVerdict& v) {
  if (v.has_cortex_shapes())
    return fmt::format(
        "no single modulus describes these cells: the outlines have the flat rear and the straight flanks of cells "
        "with a cortex (c4 {:+.4f} +- {:.4f}, c5 {:+.4f} +- {:.4f} beyond those of solids); c3 then tells little "
        "of stiffness: use `rheocyte moduli`.",
        v.cortex_mode_4.value, v.cortex_mode_4.error, v.cortex_mode_5.value, v.cortex_mode_5.error);
  if (v.is_creeping())
    return "no modulus can be recommended: the shapes change along the channel as those of cells that creep; `rheocyte "
           "time-course` tells modulus and viscosity of such cells.";
  if (!v.is_cut_off())
    return "no modulus can be recommended: the cells are not those of the table, and too few have one as elongated "
           "cells.";
  return fmt::format("no modulus can be recommended: {}; `rheocyte population` takes all events into account.",
                     cut_off_text(v));
}

/// Why the outlines tell more than area and deformation of cells whose shapes are those of the model.
std::string outlines_text(const ShapeVerdict& v) {
  if (v.is_cut_off()) return cut_off_text(v) + ".";
  return fmt::format(
      "that from area and deformation, {}, is {:.0f} % {}: pixels and errors of the segmentation change the "
      "deformation "
      "most, c3 least.",
      text_with_errors(v.by_deformation_kPa), 100 * std::abs(v.by_deformation_kPa.value / v.elongated_kPa.median - 1),
      v.by_deformation_kPa.value < v.elongated_kPa.median ? "lower" : "higher");
}

}  // namespace

std::string ShapeVerdict::recommended_text() const {
  switch (recommended()) {
    case Modulus::none: return none_text(*this);
    case Modulus::by_deformation:
      if (!std::isfinite(by_deformation_kPa.value)) return {};
      return report_text(by_deformation_kPa, "from area and deformation") +
             (fit() == Fit::model ? ": the shapes are those of the model."
                                  : "; whether the shapes are those of the model is unknown.");
    case Modulus::elongated: break;
  }
  if (fit() == Fit::model || fit() == Fit::unknown)
    return fmt::format("{}: {}", report_text(recommended_kPa(), "by the outlines"), outlines_text(*this));
  if (fit() == Fit::other_table)
    return fmt::format(
        "{}: they are not the cells of the table, but {}; the asymmetry tells about the same modulus of both; the "
        "table {} is theirs.",
        report_text(recommended_kPa(), "by the table of elongated cells"), other.cells, other.identifier);
  return fmt::format(
      "{}: the cells are {} than the flow alone would make them, which a tension of {} Pa along the flow does.",
      report_text(recommended_kPa(), "by the table of elongated cells"), excess.value < 0 ? "rounder" : "longer",
      text_with_errors(axial_tension_Pa));
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
  if (const auto text = v.recommended_text(); !text.empty()) lines.push_back(text);
  if (v.red_cells > 0)
    lines.push_back(fmt::format("{} {} above {:g}, as of red cells; {} not count here.", v.red_cells,
                                v.red_cells == 1 ? "event has an inertia ratio" : "events have inertia ratios",
                                max_inertia_ratio_of_cells, v.red_cells == 1 ? "it does" : "they do"));
  return lines;
}

}  // namespace rheocyte
