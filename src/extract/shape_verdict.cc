#include "extract/shape_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/no_value.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr double of_the_model = 0.02, still_doubtful = 0.05;              // medians of the excess
constexpr std::size_t fewest_for_a_verdict = 5, fewest_for_a_trend = 20;  // events
constexpr double min_length_um = 15;                                      // of what a recording sees, for a trend

/// Least squares over the places, without what lies four robust deviations from the median.
Trend trend_of(std::span<const double> x, std::span<const double> y, double length) {
  std::vector<double> finite;
  for (const double v : y)
    if (std::isfinite(v)) finite.push_back(v);
  if (finite.size() < fewest_for_a_trend || !(length >= min_length_um)) return {no_value, no_value, no_value};
  const CountedSample<double> sample(finite);
  const double middle = sample.quantile(0.5), widest = 4 * robust_deviation(sample);
  double n = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !(std::abs(y[i] - middle) <= widest)) continue;
    const double dx = x[i] - mean_x, dy = y[i] - mean_y;  // Welford's sums
    ++n;
    mean_x += dx / n;
    mean_y += dy / n;
    xx += dx * (x[i] - mean_x);
    xy += dx * (y[i] - mean_y);
    yy += dy * (y[i] - mean_y);
  }
  if (n < static_cast<double>(fewest_for_a_trend) || !(xx > 0)) return {no_value, no_value, middle};
  const double slope = xy / xx, rest = std::max(0.0, yy - slope * xy) / (n - 2);
  return {slope * length, std::sqrt(rest / xx) * length, middle};
}

std::string changes_text(const char* name, const Trend& trend) {
  return fmt::format("{} {:+.2g} +- {:.2g} of {:.3g}", name, trend.change, trend.error, trend.median);
}

/// Which of both explains an asymmetry that grows downstream: cells that approach the axis, or that creep. Empty where
/// it does not grow.
std::string centring_or_creep(const ShapeVerdict& v) {
  const double growth = v.direction * v.asymmetry_trend.change;
  if (!v.asymmetry_trend.is_changing() || !(growth > 0) || !std::isfinite(v.mode_4_trend.error)) return {};
  // Of a cell that approaches the axis, with its cortex as those of HL60 have it (docs/real-cells.md).
  constexpr double mode_3_per_um2 = -0.0146, mode_4_over_mode_3 = -0.007 / 0.0065, sure = 2;
  const double fall = v.direction * v.mode_4_trend.change, expected = mode_4_over_mode_3 * growth;
  const double error = std::hypot(v.mode_4_trend.error, mode_4_over_mode_3 * v.asymmetry_trend.error);
  const std::string change = fmt::format("c4 changes by {:+.2g} +- {:.1g}, {:+.2g} if cells approach the axis", fall,
                                         v.mode_4_trend.error, expected);
  if (!(fall < -sure * v.mode_4_trend.error) || !(std::abs(fall - expected) < sure * error + std::abs(expected) / 2))
    return fmt::format("; downstream c3 grows, as of cells that creep, not of cells that approach the axis ({})",
                       change);
  if (!v.beside_axis.is_centring())
    return fmt::format("; downstream c3 grows, as of cells that approach the axis ({}), but pos_y does not show it",
                       change);
  return fmt::format(
      "; downstream c3 grows, as of cells that still approach the axis, not of cells that creep ({}; "
      "it takes {:.2g} um2 of their squared distance from the axis, height included)",
      change, -growth / mode_3_per_um2);
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

void ShapeTally::take(const JudgedEvents& e) {
  const auto at = [](std::span<const double> values, std::size_t i) {
    return values.empty() ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(values[i]);
  };
  for (std::size_t i = 0; i < e.excess.size(); ++i) {
    const ShapeExcess& excess = e.excess[i];
    if (!std::isfinite(excess.excess)) continue;
    if (e.inertia_ratio[i] > max_inertia_ratio_of_cells) {
      ++red_cells_;
      continue;
    }
    const ElongationBlock& drawn = e.elongation;
    if (!drawn.modulus_kPa.empty() && std::isfinite(drawn.modulus_kPa[i]))
      drawn_.push_back({drawn.modulus_kPa[i], static_cast<float>(e.modulus_kPa[i] / drawn.modulus_kPa[i]),
                        at(drawn.elongation, i), at(drawn.axial_tension_Pa, i), at(e.mode_4_excess, i),
                        at(e.mode_5_excess, i)});
    elongated_ += excess.is_elongated() ? 1 : 0;
    const OutlineTilt tilt = e.tilt.empty() ? OutlineTilt{} : e.tilt[i];
    events_.push_back({static_cast<float>(excess.excess), static_cast<float>(excess.expected), at(e.inertia_ratio, i),
                       static_cast<float>(excess.odd_fraction), at(e.area_um2, i), at(e.deformation, i),
                       at(e.mode_3, i), at(e.x_um, i), at(e.mode_4, i), at(e.y_um, i),
                       static_cast<float>(tilt.sine_mode_2), static_cast<float>(tilt.flank_slope)});
  }
}

std::vector<double> ShapeTally::column(float Event::*member) const {
  std::vector<double> values;
  for (const Event& event : events_) values.push_back(event.*member);
  return values;
}

std::vector<double> ShapeTally::drawn(float Drawn::*member) const {
  std::vector<double> values;
  for (const Drawn& cell : drawn_) values.push_back(cell.*member);
  return values;
}

JudgedShapes ShapeTally::judged() const {
  return {column(&Event::inertia_ratio), column(&Event::area), column(&Event::deformation)};
}

BesideAxis ShapeTally::beside_axis(int direction, const ChannelFlow& flow) const {
  const auto x = column(&Event::x), y = column(&Event::y), sine = column(&Event::sine_mode_2),
             flank = column(&Event::flank_slope), area = column(&Event::area), ratio = column(&Event::inertia_ratio);
  return rheocyte::beside_axis({x, y, sine, flank, area, ratio}, direction, flow);
}

ShapeVerdict ShapeTally::verdict() const {
  ShapeVerdict v;
  v.judged = events_.size();
  v.elongated = elongated_;
  v.red_cells = red_cells_;
  const auto median = [&](float Event::*member) { return median_with_error(column(member)).value; };
  v.excess = median_with_error(column(&Event::excess));
  v.inertia_ratio = median(&Event::inertia_ratio);
  v.expected_inertia_ratio = median(&Event::expected);
  v.odd_fraction = median(&Event::odd_fraction);
  const auto x = column(&Event::x);
  auto places = x;
  std::erase_if(places, [](double place) { return !std::isfinite(place); });
  v.seen_um = central_width(places);
  v.inertia_ratio_trend = trend_of(x, column(&Event::inertia_ratio), v.seen_um);
  v.deformation_trend = trend_of(x, column(&Event::deformation), v.seen_um);
  v.asymmetry_trend = trend_of(x, column(&Event::mode_3), v.seen_um);
  v.mode_4_trend = trend_of(x, column(&Event::mode_4), v.seen_um);
  std::vector<double> moduli;
  for (const Drawn& cell : drawn_) moduli.push_back(cell.modulus_kPa);
  v.elongated_kPa = distribution_of(moduli);
  v.with_elongation = drawn_.size();
  v.modulus_ratio = median_with_error(drawn(&Drawn::ratio)).value;
  v.elongation = median_with_error(drawn(&Drawn::elongation));
  v.axial_tension_Pa = median_with_error(drawn(&Drawn::axial_tension_Pa));
  v.cortex_mode_4 = median_with_error(drawn(&Drawn::mode_4_excess));
  v.cortex_mode_5 = median_with_error(drawn(&Drawn::mode_5_excess));
  return v;
}

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
      fmt::format("inertia ratio {:.3g}, expected {:.3g}, excess {:.3f} +- {:.3f}; {:.1f} % of {} events flagged",
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

ShapeVerdict::Modulus ShapeVerdict::recommended() const {
  if (fit() == Fit::model || fit() == Fit::unknown) return Modulus::by_deformation;
  if (with_elongation < fewest_for_a_verdict || has_cortex_shapes()) return Modulus::none;
  return Modulus::elongated;
}

Median ShapeVerdict::recommended_kPa() const {
  switch (recommended()) {
    case Modulus::none: return {};
    case Modulus::by_deformation: return by_deformation_kPa;
    case Modulus::elongated: break;
  }
  // Virtual linear solids in tube and square by the table of neo-Hookean ones: 0.2 to 2.7 % high.
  const double of_another_law = fit() == Fit::other_table ? 0.025 : 0;
  return {elongated_kPa.median, elongated_kPa.median_error,
          std::hypot(elongated_common_error, of_another_law) * elongated_kPa.median};
}

std::string ShapeVerdict::recommended_text() const {
  switch (recommended()) {
    case Modulus::none:
      if (has_cortex_shapes())
        return fmt::format(
            "no single modulus describes these cells: the outlines have the flat rear and the straight flanks of cells "
            "with a cortex (c4 {:+.4f} +- {:.4f}, c5 {:+.4f} +- {:.4f} beyond those of solids); c3 then tells little "
            "of stiffness: use `rheocyte moduli`.",
            cortex_mode_4.value, cortex_mode_4.error, cortex_mode_5.value, cortex_mode_5.error);
      return "no modulus can be recommended: the cells are not those of the table, and too few have one as elongated "
             "cells.";
    case Modulus::by_deformation:
      if (!std::isfinite(by_deformation_kPa.value)) return {};
      return report_text(by_deformation_kPa, "from area and deformation") +
             (fit() == Fit::model ? ": the shapes are those of the model."
                                  : "; whether the shapes are those of the model is unknown.");
    case Modulus::elongated: break;
  }
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
  if (seen_um < min_length_um)
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
