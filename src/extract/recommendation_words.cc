#include <fmt/format.h>

#include <cmath>

#include "extract/effective_words.h"
#include "extract/recommendation.h"
#include "extract/shape_words.h"

namespace rheocyte {
namespace {

using Reason = RecommendationReason;
using Fit = ShapeVerdict::Fit;

std::string percent_of(std::size_t part, const CensoredMedian& m) {
  const double percent = 100 * double(part) / double(m.all());
  return percent < 10 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.3g} %", percent);
}

/// Which events have no modulus, and on which side of the others they are; empty if all have one.
std::string missing_text(const CensoredMedian& m) {
  std::string text;
  const auto add = [&](std::size_t events, const char* what) {
    if (events > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", percent_of(events, m), what);
  };
  add(m.below, "softer than the table");
  add(m.above, "stiffer than the table or not resolved by the pixels");
  add(m.anywhere, "longer or rounder than the table");
  return text;
}

std::string share_text(const CensoredMedian& m) {
  const std::string missing = missing_text(m);
  return missing.empty() ? fmt::format("all {} events have a modulus", m.all())
                         : fmt::format("{} of {} events have a modulus, {}", percent_of(m.known, m), m.all(), missing);
}

std::string_view source_of(const Recommendation& r, const ShapeVerdict& v) {
  if (r.way == RecommendedWay::deformation) return "from area and deformation";
  if (v.elongated_by == ElongatedBy::modes)
    return r.reason == Reason::outlines ? "from the outlines" : "from the outlines, table of elongated cells";
  return "from deformation and inertia ratio, table of elongated cells";
}

/// Behind the other systematic errors.
std::string_view selection_text(const ShapeVerdict& v) {
  return std::isfinite(v.without_shape_gates_kPa) ? ", gates on the shape" : "";
}

std::string report_text(const Recommendation& r, const ShapeVerdict& v) {
  const bool has_common = std::isfinite(r.kPa.common_error), has_scatter = std::isfinite(r.kPa.error);
  const bool lacks_cortex = r.reason == Reason::elongated && v.elongated_by == ElongatedBy::inertia;
  const bool is_of_model = r.reason != Reason::elongated && r.reason != Reason::other_table;
  const std::string systematic =
      fmt::format("pixels, table, inertia{}{}{}", is_of_model ? "" : ", cells off the axis in height",
                  lacks_cortex ? ", a cortex" : "", selection_text(v));
  const std::string errors = has_scatter && has_common ? fmt::format("errors: statistical; systematic ({})", systematic)
                                                       : "the error is statistical";
  return fmt::format("report E = {} kPa (median, {}; {}; {}; viscosity, flow rate and pixel size are not included)",
                     text_with_errors(r.kPa), source_of(r, v), share_text(r.events), errors);
}

/// By how much the modulus from area and deformation differs, where it does by more than three errors of both and 5 %.
std::string contradiction_text(const Recommendation& r, const ShapeVerdict& v) {
  constexpr double least = 0.05, sure = 3;
  const CensoredMedian& d = v.by_deformation.median_kPa;
  if (d.place != MedianPlace::inside) return {};
  const double error = std::hypot(std::hypot(d.error / d.value, v.by_deformation.common_error),
                                  std::hypot(r.kPa.error / r.kPa.value, r.kPa.common_error / r.kPa.value));
  if (!(std::abs(std::log(d.value / r.kPa.value)) > std::max(least, sure * error))) return {};
  return fmt::format(
      "; area and deformation give {:.4g} kPa, {:.0f} % {}: pixels and segmentation errors change the "
      "deformation most, the asymmetry c3 least",
      d.value, 100 * std::abs(d.value / r.kPa.value - 1), d.value < r.kPa.value ? "less" : "more");
}

/// Without outlines a cortex cannot be seen.
std::string_view solid_text(const ShapeVerdict& v) {
  return v.elongated_by == ElongatedBy::modes && v.has_elongated_table
             ? ""
             : " It is the modulus of homogeneous solids: without outlines a cortex cannot be excluded.";
}

/// What is comparable with moduli of other programs.
std::string by_deformation_text(const ShapeVerdict& v) {
  const CensoredMedian& m = v.by_deformation.median_kPa;
  if (m.place == MedianPlace::inside)
    return fmt::format("Area and deformation alone, as in most publications, give {:.3g} kPa.", m.value);
  return "Area and deformation alone give no median: too many events are beyond their table.";
}

std::string_view effective_reason_text(const ShapeVerdict& v) {
  return v.is_tension_given ? "the axial tension of the liquid is given"
                            : "the cells are longer than the flow alone would make them";
}

std::string effective_text(const Recommendation& r, const ShapeVerdict& v) {
  const EffectiveCell& cell = v.effective;
  const std::string of_solids =
      v.has_cortex_shapes() ? "" : "Homogeneous solids, which only outlines can exclude, would have 30 to 55 % more.";
  std::string comparisons;
  for (const std::string& sentence : {by_ratios_text(cell), of_solids, by_deformation_text(v)})
    if (!sentence.empty()) comparisons += " " + sentence;
  return fmt::format(
      "report an effective Young's modulus of {} kPa (cell with the median {} of {} events; errors: statistical; "
      "systematic (pixels, section, proportions and law of the cortex, inertia, cells off the axis in height{}); "
      "viscosity, "
      "flow rate and pixel size are not included): {}. A homogeneous solid of this modulus is elongated equally by a "
      "small tension. With the proportions of HL60 cells, bulk and cortex have E + E2D/r0 = {} kPa, and the axial "
      "tension is {} Pa, {:.2g} of the wall shear stress.{}",
      text_with_errors(r.kPa, 3), effective_data_text(cell), cell.events, selection_text(v), effective_reason_text(v),
      text_with_errors(cell.stiffness_kPa, 3), text_with_errors(cell.axial_tension_Pa, 3),
      cell.axial_tension_Pa.value / cell.wall_stress_Pa, comparisons);
}

std::string number_text(const Recommendation& r, const ShapeVerdict& v) {
  const std::string report = report_text(r, v);
  switch (r.reason) {
    case Reason::outlines:
      return fmt::format("{}: the shapes are those of the model{}.", report, contradiction_text(r, v));
    case Reason::of_model: return fmt::format("{}: the shapes are those of the model.{}", report, solid_text(v));
    case Reason::other_table:
      return fmt::format(
          "{}: the cells are {}; the asymmetry gives both laws nearly the same modulus. Their table is {}.", report,
          v.other.cells, v.other.identifier);
    case Reason::elongated:
      return fmt::format(
          "{}: the cells are {} than the flow alone would make them. An axial tension of {} Pa explains "
          "it; so do cells off the axis in height (by 2 um: E 20 to 25 % too high).{}",
          report, v.excess.value < 0 ? "rounder" : "longer", text_with_errors(v.axial_tension_Pa), solid_text(v));
    default:
      return report +
             ". Whether the shapes are those of the model is unknown: it is the modulus of homogeneous solids "
             "that nothing but the flow deforms.";
  }
}

std::string bound_text(const Recommendation& r, const ShapeVerdict& v) {
  const bool is_soft = r.events.place == MedianPlace::below;
  const std::string bound = std::isfinite(r.bound_kPa) ? fmt::format("{} than {:.3g} kPa", r.bound(), r.bound_kPa)
                                                       : fmt::format("{} than the cells of the table", r.bound());
  return fmt::format(
      "no modulus is recommended, only a bound: the median cell is {} ({}). The median of the events with "
      "a modulus would be that of the {} cells.{}",
      bound, share_text(r.events), is_soft ? "stiffer" : "softer", solid_text(v));
}

std::string none_text(const Recommendation& r, const ShapeVerdict& v) {
  switch (r.reason) {
    case Reason::cortex:
      return fmt::format(
          "no single modulus describes these cells: the outlines have the flat rear and the straight flanks of cells "
          "with a cortex (beyond those of solids: c4 {:+.4f} +- {:.4f}, c5 {:+.4f} +- {:.4f}). A solid's modulus would "
          "be {:.3g} kPa and up to 35 % off; use `rheocyte moduli` or `rheocyte population --model cortex`.",
          v.cortex_mode_4.value, v.cortex_mode_4.error, v.cortex_mode_5.value, v.cortex_mode_5.error,
          v.elongated_kPa.median);
    case Reason::creeping:
      return "no modulus is recommended: the shapes change along the channel as those of cells that creep. `rheocyte "
             "time-course` determines modulus and viscosity of such cells.";
    case Reason::too_few_events:
      return fmt::format("no modulus is recommended: {} event{} too few for a median (minimum {}).", r.events.all(),
                         r.events.all() == 1 ? " is" : "s are", min_events_of_recommendation);
    case Reason::no_table:
      return "no modulus is recommended: the cells are not those of the table, and there is no table of elongated "
             "cells "
             "for this channel (section square has one).";
    case Reason::beyond_table: return bound_text(r, v);
    default:
      return fmt::format(
          "no modulus is recommended: too few events have one, and the others do not lie on one side ({}).",
          share_text(r.events));
  }
}

std::string maxima_text(const DensityMaxima& log_maxima) {
  if (!log_maxima.are_two()) return {};
  return fmt::format(
      " The moduli have two maxima, near {:.2g} and {:.2g} kPa, with {:.0f} % of the cells below {:.2g} "
      "kPa: for two populations the median is that of neither; gates can separate them.",
      std::exp(log_maxima.lower), std::exp(log_maxima.upper), 100 * log_maxima.fraction_below,
      std::exp(log_maxima.minimum));
}

}  // namespace

std::string recommendation_text(const Recommendation& r, const ShapeVerdict& v) {
  if (r.events.all() == 0 && v.judged == 0) return {};
  if (r.reason == Reason::effective) return effective_text(r, v);
  if (v.has_effective_modulus() && v.effective.place != EffectivePlace::unknown && r.reason != Reason::creeping)
    return fmt::format("no modulus is recommended{}: {}", std::isfinite(r.bound_kPa) ? ", only a bound" : "",
                       effective_place_text(v.effective));
  return r.way == RecommendedWay::none ? none_text(r, v) : number_text(r, v) + maxima_text(r.log_maxima);
}

}  // namespace rheocyte
