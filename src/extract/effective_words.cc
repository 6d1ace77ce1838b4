#include "extract/effective_words.h"

#include <fmt/format.h>

#include <cmath>

namespace rheocyte {

std::string_view effective_data_text(const EffectiveCell& cell) {
  return cell.is_by_ratios ? "area, deformation and inertia ratio" : "area and deformation";
}

std::string effective_place_text(const EffectiveCell& cell) {
  const std::string median = fmt::format("the median {} of {} events", effective_data_text(cell), cell.events);
  const auto compared = [&](std::string_view what) {
    return fmt::format("the cell with {} is {} of the table.", median, what);
  };
  switch (cell.place) {
    case EffectivePlace::softer:
      return fmt::format(
          "the cell with {} is softer than the softest cell of its size in the table, whose effective Young's modulus "
          "is {:.3g} kPa.",
          median, cell.softest_kPa);
    case EffectivePlace::longer: return compared("longer than the cells");
    case EffectivePlace::stiffer: return compared("stiffer or rounder than the cells");
    case EffectivePlace::other_size: return compared("not of the sizes");
    case EffectivePlace::ambiguous:
      return fmt::format(
          "cells of different stiffness have {}: these are long and hardly asymmetric. `rheocyte moduli` determines "
          "moduli from outlines.",
          median);
    default: return "the median cell has no modulus.";
  }
}

std::string by_ratios_text(const EffectiveCell& cell) {
  if (!std::isfinite(cell.by_ratios_kPa)) return {};
  return fmt::format("Without the given tension, the inertia ratios determine {:.3g} Pa and {:.3g} kPa.",
                     cell.by_ratios_tension_Pa, cell.by_ratios_kPa);
}

}  // namespace rheocyte
