// Which Young's modulus of a recording is to be reported, with its errors, or why there is none: one rule for all
// commands (docs/theory-extract.md, sec. "The recommended number").
#pragma once
#include <string>
#include <string_view>

#include "extract/shape_verdict.h"

namespace rheocyte {

/// Fewer events have no recommended number.
inline constexpr std::size_t min_events_of_recommendation = 20;

enum class RecommendedWay { none, deformation, elongated, effective };

/// Why this number, or why none.
enum class RecommendationReason {
  of_model,        ///< the shapes are those of the model
  shapes_unknown,  ///< nothing is known of the shapes
  outlines,        ///< the shapes are those of the model, and the outlines determine the modulus of nearly all events
  elongated,       ///< the cells are longer or rounder than the flow makes them
  other_table,     ///< the shapes are those of another of the program's tables
  too_few_events,  ///< fewer than min_events_of_recommendation
  cortex,          ///< the outlines are those of cells with a cortex: no single modulus describes them
  creeping,        ///< the shapes change along the channel as those of cells that creep
  beyond_table,    ///< the median lies beyond one end of the table: there is a bound
  outside_table,   ///< too few events have a modulus, and not on one side
  no_table,        ///< the cells are elongated, and there is no table of elongated cells for this channel
  effective        ///< the cells are longer than the flow makes them: the effective modulus of the median cell
};
/// As in files: "model", "shapes-unknown", ...
std::string_view code_of(RecommendationReason reason);

struct Recommendation {
  RecommendedWay way = RecommendedWay::none;  ///< none unless there is a number
  RecommendationReason reason = RecommendationReason::too_few_events;
  Median kPa = {};              ///< with both errors; NaN without a number. That of gates on the shape is in common
  CensoredMedian events = {};   ///< how many events have a modulus by the way that was judged, and how many lie beyond
  double bound_kPa = no_value;  ///< of a median beyond the table; the side is events.place
  DensityMaxima log_maxima = {};  ///< of ln(E / kPa): two populations have two

  /// "softer", "stiffer", or empty without a bound.
  std::string_view bound() const;
};

Recommendation recommendation(const ShapeVerdict& verdict);

/// In one or two sentences; empty if the recording has no events.
std::string recommendation_text(const Recommendation& recommendation, const ShapeVerdict& verdict);

}  // namespace rheocyte
