#include "report/verdict_columns.h"

#include <array>

#include "report/distribution_columns.h"

namespace rheocyte {

namespace {

using V = ShapeVerdict;

ColumnDescription verdict_number(std::string name, std::string_view unit, std::string label, std::string sentence) {
  return {std::move(name), unit, std::move(label), std::move(sentence), {}, 0, digits_of_values};
}

ColumnDescription verdict_word(std::string name, std::string label, std::string sentence) {
  return {std::move(name), {}, std::move(label), std::move(sentence)};
}

auto verdict_value(Median V::*median) {
  return [median](const V& v) { return (v.*median).value; };
}
auto verdict_error(Median V::*median) {
  return [median](const V& v) { return (v.*median).error; };
}
auto verdict_common_error(Median V::*median) {
  return [median](const V& v) { return (v.*median).common_error; };
}
auto verdict_change(Trend V::*trend) {
  return [trend](const V& v) { return (v.*trend).change; };
}

std::string elongated_by(const V& v) {
  if (v.with_elongation == 0) return {};
  return v.elongated_by == ElongatedBy::modes ? "outlines" : "inertia ratio";
}

std::string_view fit_word(const V& v) {
  constexpr std::array<std::string_view, 6> words{"unknown",  "model",     "other-table",
                                                  "doubtful", "elongated", "rounder"};
  return words.at(static_cast<std::size_t>(v.fit()));
}

}  // namespace

Columns<V> elongation_summary_columns() {
  ColumnList<V> list;
  add_quartiles(list,
                {"young_modulus_elongated", "kPa", "kPa", "E as of an elongated cell",
                 "Young's modulus by the table of elongated cells"},
                [](const V& v) { return v.elongated_kPa; });
  list.add_count("with_elongation", &V::with_elongation)
      .add(verdict_word("elongated_by", "Elongation from", "\"outlines\" or \"inertia ratio\""), elongated_by)
      .add(verdict_number("deformation_over_elongated_modulus", "", "E from deformation over E as of an elongated cell",
                          "median of E from area and deformation over that by the table of elongated cells"),
           &V::modulus_ratio)
      .add_with_errors(
          verdict_number("elongation_median", "", "Elongation by the axial tension, median",
                         "length over width that only the tension of the liquid would give the median cell"),
          verdict_value(&V::elongation), verdict_error(&V::elongation), verdict_common_error(&V::elongation))
      .add_with_errors(verdict_number("axial_tension_median_Pa", "Pa", "Axial tension of the liquid, median",
                                      "tension of the liquid along the flow that elongates the cells this much"),
                       verdict_value(&V::axial_tension_Pa), verdict_error(&V::axial_tension_Pa),
                       verdict_common_error(&V::axial_tension_Pa))
      .add(verdict_number(
               "mode_4_beyond_solids", "", "Mode c4 beyond that of solids",
               "median of c_4 less that of the solid of this size and modulus; cells with a cortex have more"),
           verdict_value(&V::cortex_mode_4))
      .add(verdict_number("mode_5_beyond_solids", "", "Mode c5 beyond that of solids", "the same of c_5"),
           verdict_value(&V::cortex_mode_5));
  return std::move(list).columns();
}

Columns<V> verdict_columns() {
  ColumnList<V> list;
  list.add(verdict_word("shapes", "Shapes",
                        "\"model\", \"other-table\", \"doubtful\", \"elongated\", \"rounder\" or \"unknown\""),
           fit_word)
      .add(verdict_word("shapes_of_model", "Cells of the table", "kind of cells of the table"), &V::model)
      .add(
          verdict_word("fitting_table", "Fitting table", "another table, whose cells have the shapes of the recording"),
          [](const V& v) { return v.other.identifier; })
      .add(verdict_number("modulus_over_that_of_fitting_table", "", "E over that of the fitting table",
                          "median of E from area and deformation over that by the fitting table"),
           [](const V& v) { return v.other.modulus_over_its; })
      .add_with_error(verdict_number("shape_excess_median", "", "Shape excess, median",
                                     "median of inertia ratio - that of the table's cell of this area and deformation"),
                      verdict_value(&V::excess), verdict_error(&V::excess))
      .add(verdict_number("inertia_ratio_median", "", "Inertia ratio, median", "median of the measured ones"),
           &V::inertia_ratio)
      .add(verdict_number("inertia_ratio_expected", "", "Inertia ratio, expected",
                          "median of those of the table's cells"),
           &V::expected_inertia_ratio)
      .add(verdict_number("elongated_percent", "%", "Elongated cells",
                          "events that are longer along the flow than the model's"),
           &V::elongated_percent)
      .add(verdict_number("odd_fraction_median", "", "Odd fraction of the outline, median",
                          "fraction of the deformation that is not that of an ellipse of this inertia ratio"),
           &V::odd_fraction)
      .add_count("red_cells", &V::red_cells)
      .add(verdict_number("inertia_ratio_change", "", "Change of the inertia ratio",
                          "along the visible part of the channel"),
           verdict_change(&V::inertia_ratio_trend))
      .add_with_error(verdict_number("deformation_change", "", "Change of the deformation",
                                     "along the visible part of the channel"),
                      verdict_change(&V::deformation_trend), [](const V& v) { return v.deformation_trend.error; })
      .add(verdict_number("mode_3_change", "", "Change of mode c3", "along the visible part of the channel"),
           verdict_change(&V::asymmetry_trend));
  return std::move(list).columns();
}

Columns<BesideAxis> beside_axis_columns() {
  using B = BesideAxis;
  ColumnList<B> list;
  list.add(verdict_number("pos_y_rms_um", "um", "Scatter across the channel",
                          "root mean square of pos_y about its mean"),
           &B::spread_um)
      .add_with_error(
          verdict_number("sine_mode_2_per_um", "1/um", "Sine mode s2 over pos_y", "slope of the tilt over pos_y"),
          [](const B& b) { return b.sine_slope.value; }, [](const B& b) { return b.sine_slope.error; })
      .add_with_error(
          verdict_number("flank_slope_per_um", "1/um", "Slope of the flanks over pos_y",
                         "how the slope of the flanks depends on pos_y"),
          [](const B& b) { return b.flank_slope.value; }, [](const B& b) { return b.flank_slope.error; })
      .add(verdict_number("flank_slope_change_per_um", "1/um", "Slope of the flanks over pos_y, change",
                          "from the first to the last third of the visible part of the channel"),
           [](const B& b) { return b.flank_change().value; })
      .add(verdict_number("flank_slope_stored_per_um", "1/um", "Slope of the flanks over pos_y of a stored shape",
                          "by how much a shape that the cells keep would have turned on that distance"),
           &B::stored_slope)
      .add_with_error(
          verdict_number("pos_y_rms_change_per_um", "1/um", "Change of the scatter across the channel",
                         "relative, per um downstream"),
          [](const B& b) { return b.centring.value; }, [](const B& b) { return b.centring.error; });
  return std::move(list).columns();
}

}  // namespace rheocyte
