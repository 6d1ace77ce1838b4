#include "report/methods_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "events/companion_origin.h"
#include "extract/effective_words.h"
#include "extract/recommendation.h"

namespace rheocyte {
namespace {

std::string effective_law_text(const EffectiveCell& cell) {
  const std::string unknowns = cell.is_by_ratios
                                   ? "Radius, stiffness and the axial tension of the liquid were determined"
                                   : fmt::format(
                                         "Under an axial tension of the liquid of {:.3g} Pa, radius and "
                                         "stiffness were determined",
                                         cell.axial_tension_Pa.value);
  return fmt::format(
      "The effective Young's modulus is that of the homogeneous solid which a small axial tension elongates as much as "
      "the cell with its bulk, cortex and cortical tension. {} from the medians of {} of the events of each recording "
      "(cells with a neo-Hookean bulk and cortex in the proportions of HL60 cells, {}; Young's modulus of the bulk, "
      "area modulus and tension of the cortex in fixed ratios).",
      unknowns, effective_data_text(cell), cell.section == Section::square ? "square channel" : "tube");
}

/// Channel, liquid, pixels and gates.
std::string measurement_text(const RecordingFacts& r, double viscosity_mPas) {
  const ChannelFlow& flow = r.conditions.flow;
  std::string text = fmt::format("Channel of {:g} um, flow rate {:g} ul/s", flow.width_um, flow.rate_ul_s);
  text += r.medium.empty()
              ? fmt::format(", viscosity {:.3g} mPa s (given)", viscosity_mPas)
              : fmt::format(", {} with {:.3g} mPa s (model {}{})", r.medium, viscosity_mPas, r.viscosity_model,
                            r.temperature.empty() ? std::string() : ", temperature " + r.temperature);
  if (r.pixel_size_um > 0) text += fmt::format(", pixels of {:g} um, corrected for", r.pixel_size_um);
  return text + (r.gates.empty() ? "." : fmt::format(", events with {}.", r.gates));
}

std::string law_text(const ExtractSummary& s, const Recommendation& r) {
  switch (r.way) {
    case RecommendedWay::effective: return effective_law_text(s.shapes.effective);
    case RecommendedWay::elongated:
      return "Young's modulus is that of homogeneous neo-Hookean solids in a square channel that are elongated by an "
             "axial "
             "tension of the liquid, event by event; the median over the events is given.";
    default:
      return fmt::format(
          "Young's modulus follows from area and deformation of each event by the look-up table {} ({}); the median "
          "over "
          "the events is given.",
          s.table, s.shapes.model.empty() ? "cells that nothing but the flow deforms" : s.shapes.model);
  }
}

std::string_view name_of_test(const ConditionComparison& comparison) {
  return comparison.is_paired ? "a paired t test" : "Welch's t test";
}

}  // namespace

std::string methods_text(const ExtractSummary& s) {
  const Recommendation r = recommendation(s.shapes);
  if (r.way == RecommendedWay::none) return {};
  return fmt::format("Moduli were computed with {} (settings hash {}). {} {}", program(), s.settings_hash,
                     law_text(s, r), measurement_text(s, s.mean_viscosity_mPas));
}

std::string methods_text(const PopulationReport& report) {
  const auto first = std::ranges::find_if(report.recordings, [](const auto& r) { return r.failure.empty(); });
  if (first == report.recordings.end()) return {};
  std::string text = fmt::format("Moduli were computed with {} (rheocyte population --model {}, settings hash {}).",
                                 program(), report.model, first->settings_hash);
  if (report.model == "effective")
    text += " " + effective_law_text(first->effective.value());
  else if (report.model == "solid")
    text +=
        " The distribution of radius and Young's modulus of homogeneous neo-Hookean solids in each recording was "
        "fitted to the areas and shapes of its events, including the noise of the pixels and the gates.";
  else
    text +=
        " The distribution of cells with a neo-Hookean bulk, a cortex and its tension under a common axial tension "
        "of the liquid was fitted to the moments of the outlines of each recording.";
  if (!report.comparisons.empty())
    text += fmt::format(
        " Conditions were compared by {} on the logarithms of the recordings' medians; intervals are "
        "those of {:g} %.",
        name_of_test(report.comparisons.front()), 100 * report.level);
  return text + " " + measurement_text(*first, first->median_viscosity_mPas);
}

}  // namespace rheocyte
