#include "report/summary_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "extract/recommendation.h"

namespace rheocyte {

namespace {

using S = ExtractSummary;
struct Entry {
  std::string name;
  std::function<CellValue(const S&)> value;
  int digits = 0;
};
using Entries = std::vector<Entry>;

std::string all_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const auto& sentence : sentences) text.append(text.empty() ? "" : " ").append(sentence);
  return text;
}

/// A number or a text of the verdict on the shapes.
std::function<CellValue(const S&)> of_shapes(auto value) {
  return [value](const S& s) -> CellValue { return std::invoke(value, s.shapes); };
}

std::function<CellValue(const S&)> beside_axis(auto value) {
  return [value](const S& s) -> CellValue { return std::invoke(value, s.shapes.beside_axis); };
}

std::string beside_axis_text(const BesideAxis& b) {
  const std::string turn = b.turn_text(), centring = b.centring_text();
  return turn + (turn.empty() || centring.empty() ? "" : " ") + centring;
}

Entries counts() {
  Entries columns{{"events", [](const S& s) { return double(s.recorded); }, digits_of_counts}};
  for (std::size_t k = 0; k < states_by_deformation().size(); ++k) {
    std::string name(states_by_deformation()[k]);
    std::ranges::replace(name, ' ', '_');
    columns.push_back({name, [k](const S& s) { return double(s.counts[k]); }, digits_of_counts});
  }
  columns.push_back({"cut_by_the_edge", [](const S& s) { return double(s.counts[std::size_t(ModulusState::cut)]); },
                     digits_of_counts});
  return columns;
}

Entries of_modulus() {
  return {{"with_modulus_percent",
           [](const S& s) { return 100 * double(s.with_modulus()) / double(std::max<std::size_t>(s.recorded, 1)); }},
          {"young_modulus_median_kPa", [](const S& s) { return s.modulus_kPa.median; }},
          {"young_modulus_median_error_kPa", [](const S& s) { return s.modulus_kPa.median_error; }},
          {"young_modulus_first_quartile_kPa", [](const S& s) { return s.modulus_kPa.first_quartile; }},
          {"young_modulus_third_quartile_kPa", [](const S& s) { return s.modulus_kPa.third_quartile; }},
          {"young_modulus_mean_kPa", [](const S& s) { return s.modulus_kPa.mean; }},
          {"young_modulus_standard_deviation_kPa", [](const S& s) { return s.modulus_kPa.standard_deviation; }},
          {"young_modulus_standard_error_median_kPa", &S::median_standard_error_kPa}};
}

/// A number or a text of the recommended modulus.
std::function<CellValue(const S&)> of_recommendation(auto value) {
  return [value](const S& s) -> CellValue { return std::invoke(value, recommendation(s.shapes)); };
}

Entries of_recommended_modulus() {
  using R = Recommendation;
  constexpr std::array ways{"none", "deformation", "elongated"};
  return {
      {"recommended_modulus", of_recommendation([=](const R& r) { return ways.at(static_cast<std::size_t>(r.way)); })},
      {"recommended_young_modulus_median_kPa", of_recommendation([](const R& r) { return r.kPa.value; })},
      {"recommended_young_modulus_median_error_kPa", of_recommendation([](const R& r) { return r.kPa.error; })},
      {"recommended_young_modulus_common_error_kPa", of_recommendation([](const R& r) { return r.kPa.common_error; })},
      {"recommended_reason", of_recommendation([](const R& r) { return std::string(code_of(r.reason)); })},
      {"recommended_bound", of_recommendation([](const R& r) { return std::string(r.bound()); })},
      {"recommended_bound_kPa", of_recommendation([](const R& r) { return r.bound_kPa; })},
      {"recommended_share_percent", of_recommendation([](const R& r) { return 100 * r.events.share(); })},
      {"recommended_text",
       [](const S& s) -> CellValue { return recommendation_text(recommendation(s.shapes), s.shapes); }}};
}

Entries of_elongation() {
  using V = ShapeVerdict;
  return {
      {"young_modulus_elongated_median_kPa", of_shapes([](const V& v) { return v.elongated_kPa.median; })},
      {"young_modulus_elongated_median_error_kPa", of_shapes([](const V& v) { return v.elongated_kPa.median_error; })},
      {"young_modulus_elongated_first_quartile_kPa",
       of_shapes([](const V& v) { return v.elongated_kPa.first_quartile; })},
      {"young_modulus_elongated_third_quartile_kPa",
       of_shapes([](const V& v) { return v.elongated_kPa.third_quartile; })},
      {"with_elongation", of_shapes([](const V& v) { return double(v.with_elongation); }), digits_of_counts},
      {"elongated_by", of_shapes([](const V& v) {
         if (v.with_elongation == 0) return "";
         return v.elongated_by == ElongatedBy::modes ? "outlines" : "inertia ratio";
       })},
      {"deformation_over_elongated_modulus", of_shapes(&V::modulus_ratio)},
      {"elongation_median", of_shapes([](const V& v) { return v.elongation.value; })},
      {"elongation_median_error", of_shapes([](const V& v) { return v.elongation.error; })},
      {"elongation_common_error", of_shapes([](const V& v) { return v.elongation.common_error; })},
      {"axial_tension_median_Pa", of_shapes([](const V& v) { return v.axial_tension_Pa.value; })},
      {"axial_tension_median_error_Pa", of_shapes([](const V& v) { return v.axial_tension_Pa.error; })},
      {"axial_tension_common_error_Pa", of_shapes([](const V& v) { return v.axial_tension_Pa.common_error; })},
      {"mode_4_beyond_solids", of_shapes([](const V& v) { return v.cortex_mode_4.value; })},
      {"mode_5_beyond_solids", of_shapes([](const V& v) { return v.cortex_mode_5.value; })}};
}

Entries of_verdict() {
  using V = ShapeVerdict;
  constexpr std::array fits{"unknown", "model", "other-table", "doubtful", "elongated", "rounder"};
  return {{"shapes", of_shapes([=](const V& v) { return fits.at(static_cast<std::size_t>(v.fit())); })},
          {"shapes_of_model", of_shapes(&V::model)},
          {"fitting_table", of_shapes([](const V& v) { return v.other.identifier; })},
          {"modulus_over_that_of_fitting_table", of_shapes([](const V& v) { return v.other.modulus_over_its; })},
          {"shape_excess_median", of_shapes([](const V& v) { return v.excess.value; })},
          {"shape_excess_median_error", of_shapes([](const V& v) { return v.excess.error; })},
          {"inertia_ratio_median", of_shapes(&V::inertia_ratio)},
          {"inertia_ratio_expected", of_shapes(&V::expected_inertia_ratio)},
          {"elongated_percent", of_shapes(&V::elongated_percent)},
          {"odd_fraction_median", of_shapes(&V::odd_fraction)},
          {"red_cells", of_shapes([](const V& v) { return double(v.red_cells); }), digits_of_counts},
          {"inertia_ratio_change", of_shapes([](const V& v) { return v.inertia_ratio_trend.change; })},
          {"deformation_change", of_shapes([](const V& v) { return v.deformation_trend.change; })},
          {"deformation_change_error", of_shapes([](const V& v) { return v.deformation_trend.error; })},
          {"mode_3_change", of_shapes([](const V& v) { return v.asymmetry_trend.change; })}};
}

Entries of_places() {
  using B = BesideAxis;
  return {{"pos_y_rms_um", beside_axis(&B::spread_um)},
          {"sine_mode_2_per_um", beside_axis([](const B& b) { return b.sine_slope.value; })},
          {"sine_mode_2_per_um_error", beside_axis([](const B& b) { return b.sine_slope.error; })},
          {"flank_slope_per_um", beside_axis([](const B& b) { return b.flank_slope.value; })},
          {"flank_slope_per_um_error", beside_axis([](const B& b) { return b.flank_slope.error; })},
          {"flank_slope_per_um_change", beside_axis([](const B& b) { return b.flank_change().value; })},
          {"flank_slope_per_um_stored", beside_axis(&B::stored_slope)},
          {"pos_y_rms_change_per_um", beside_axis([](const B& b) { return b.centring.value; })},
          {"pos_y_rms_change_per_um_error", beside_axis([](const B& b) { return b.centring.error; })},
          {"shapes_text", of_shapes(&ShapeVerdict::text)},
          {"trend_text", of_shapes(&ShapeVerdict::trend_text)},
          {"beside_axis_text", beside_axis(beside_axis_text)}};
}

Entries of_settings() {
  return {{"table", &S::table},
          {"medium", &S::medium},
          {"viscosity_model", &S::viscosity_model},
          {"mean_viscosity_mPas", &S::mean_viscosity_mPas},
          {"temperature", &S::temperature},
          {"channel_width_um", [](const S& s) { return s.conditions.flow.width_um; }},
          {"flow_rate_ul_s", [](const S& s) { return s.conditions.flow.rate_ul_s; }},
          {"pixelation_pixel_size_um", [](const S& s) { return s.conditions.pixel_size_um; }},
          {"corrected_for_pixels", &S::corrected},
          {"gates", &S::gates},
          {"area_from", &S::area_from},
          {"deformation_from", &S::deformation_from},
          {"sample", [](const S& s) { return s.labels.sample; }},
          {"date", [](const S& s) { return s.labels.date; }},
          {"time", [](const S& s) { return s.labels.time; }},
          {"run_index", [](const S& s) { return s.labels.run_index; }},
          {"chip", [](const S& s) { return s.labels.chip; }},
          {"remarks", [](const S& s) { return all_of(s.warnings); }}};
}

}  // namespace

std::string summary_text(const Column<ExtractSummary>& column, const ExtractSummary& summary) {
  const CellValue value = column.value(summary);
  return has_value(value) ? cell_text(column, value) : "";
}

const Columns<S>& summary_columns() {
  static const Columns<S> columns = [] {
    Columns<S> all;
    for (const auto& part :
         {counts(), of_recommended_modulus(), of_modulus(), of_elongation(), of_verdict(), of_places(), of_settings()})
      for (const Entry& entry : part) all.push_back({{.name = entry.name, .digits = entry.digits}, entry.value});
    return all;
  }();
  return columns;
}

}  // namespace rheocyte
