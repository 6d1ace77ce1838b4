#include "extract/recommendation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "extract/common_errors.h"

namespace rheocyte {
namespace {

using Fit = ShapeVerdict::Fit;
using Reason = RecommendationReason;

/// Of the events: with so many the outlines count more than the deformation, which errors of pixels change most.
constexpr double share_of_outlines = 0.95;

bool has_model_shapes(const ShapeVerdict& v) { return v.fit() == Fit::model || v.fit() == Fit::unknown; }

bool are_outlines_preferred(const ShapeVerdict& v) {
  const CensoredMedian& outlines = v.by_elongation.median_kPa;
  return v.elongated_by == ElongatedBy::modes && outlines.place == MedianPlace::inside &&
         outlines.share() >= std::min(share_of_outlines, v.by_deformation.median_kPa.share());
}

/// The way that is judged, and why it is.
struct JudgedWay {
  RecommendedWay way;
  Reason reason;
};

JudgedWay judged_way_of(const ShapeVerdict& v) {
  if (has_model_shapes(v)) {
    if (are_outlines_preferred(v)) return {RecommendedWay::elongated, Reason::outlines};
    return {RecommendedWay::deformation, v.fit() == Fit::model ? Reason::of_model : Reason::shapes_unknown};
  }
  return {RecommendedWay::elongated, v.fit() == Fit::other_table ? Reason::other_table : Reason::elongated};
}

/// What all events share, relative.
double common_error_of(const JudgedWay& choice, const ShapeVerdict& v, const JudgedModulus& judged) {
  double error = judged.common_error;
  if (!has_model_shapes(v)) error = std::hypot(error, std::hypot(error_of_height, common_error_of_other_shapes));
  if (choice.reason == Reason::elongated && v.elongated_by == ElongatedBy::inertia)
    error = std::hypot(error, error_of_unseen_cortex);
  return std::hypot(error, judged.median_kPa.half_range / judged.median_kPa.value);
}

double bound_of(const JudgedModulus& judged) {
  const CensoredMedian& m = judged.median_kPa;
  return std::isfinite(m.bound) || m.place == MedianPlace::above ? m.bound : judged.soft_end_kPa;
}

/// All events have a part in the medians.
Recommendation effective_recommendation(const EffectiveCell& cell) {
  Recommendation r{.reason = Reason::outside_table};
  r.events.known = cell.events;
  switch (cell.place) {
    case EffectivePlace::inside:
      r.way = RecommendedWay::effective, r.reason = Reason::effective, r.kPa = cell.effective_kPa;
      r.events.place = MedianPlace::inside;
      break;
    case EffectivePlace::softer:
      r.reason = Reason::beyond_table, r.bound_kPa = cell.softest_kPa;
      r.events.place = MedianPlace::below;
      break;
    case EffectivePlace::unknown:
    case EffectivePlace::longer:
    case EffectivePlace::stiffer:
    case EffectivePlace::other_size:
    case EffectivePlace::ambiguous: break;
  }
  return r;
}

Recommendation of_selected_cells(const ShapeVerdict& v) {
  if (v.has_effective_modulus() && v.effective.place != EffectivePlace::unknown && !v.is_creeping())
    return effective_recommendation(v.effective);
  const JudgedWay choice = judged_way_of(v);
  const JudgedModulus& judged = choice.way == RecommendedWay::deformation ? v.by_deformation : v.by_elongation;
  const CensoredMedian& median = judged.median_kPa;
  Recommendation r{.reason = choice.reason, .events = median, .log_maxima = judged.log_maxima};
  if (v.has_cortex_shapes()) return r.reason = Reason::cortex, r;
  if (v.is_creeping()) return r.reason = Reason::creeping, r;
  if (choice.way == RecommendedWay::elongated && !v.has_elongated_table) return r.reason = Reason::no_table, r;
  if (median.all() < min_events_of_recommendation) return r.reason = Reason::too_few_events, r;
  switch (median.place) {
    case MedianPlace::undetermined: return r.reason = Reason::outside_table, r;
    case MedianPlace::below:
    case MedianPlace::above: return r.reason = Reason::beyond_table, r.bound_kPa = bound_of(judged), r;
    case MedianPlace::inside: break;
  }
  r.way = choice.way;
  r.kPa = {median.value, std::fmax(median.error, judged.least_error_kPa),
           common_error_of(choice, v, judged) * median.value};
  return r;
}

}  // namespace

std::string_view code_of(RecommendationReason reason) {
  constexpr std::array<std::string_view, 12> codes{
      "model",  "shapes-unknown", "outlines",     "elongated",     "other-table",        "too-few-events",
      "cortex", "creeping",       "beyond-table", "outside-table", "no-elongated-table", "effective"};
  return codes.at(static_cast<std::size_t>(reason));
}

std::string_view Recommendation::bound() const {
  if (reason != Reason::beyond_table) return "";
  return events.place == MedianPlace::below ? "softer" : "stiffer";
}

Recommendation recommendation(const ShapeVerdict& v) {
  Recommendation r = of_selected_cells(v);
  if (std::isfinite(v.without_shape_gates_kPa) && r.way != RecommendedWay::none)
    r.kPa.common_error =
        std::hypot(r.kPa.common_error, r.kPa.value * std::log(r.kPa.value / v.without_shape_gates_kPa));
  return r;
}

}  // namespace rheocyte
