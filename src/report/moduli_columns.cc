#include "report/moduli_columns.h"

#include <array>
#include <cmath>
#include <utility>

#include "report/elongation_columns.h"

namespace rheocyte {

namespace {

constexpr int digits_of_ratios = 4;

std::span<const std::string_view> words_of_statuses() {
  static const auto words = [] {
    std::array<std::string_view, moduli_status_count> names;
    for (int k = 0; k < moduli_status_count; ++k) names[std::size_t(k)] = name_of(ModuliStatus(k));
    return names;
  }();
  return words;
}

/// A number of an estimate.
auto of_estimates(auto number) { return of_each(&ModuliBlock::estimates, number); }

struct NamedModulus {
  Modulus modulus;
  std::string quantity, unit, label;
};
const std::array<NamedModulus, modulus_count>& moduli() {
  static const std::array<NamedModulus, modulus_count> all{
      {{Modulus::young, "young_modulus", "kPa", "E of the bulk"},
       {Modulus::cortex, "cortex_modulus", "mN_per_m", "Cortex modulus E2D"},
       {Modulus::tension, "tension", "mN_per_m", "Cortex tension"}}};
  return all;
}

std::string_view unit_text(const NamedModulus& named) { return named.modulus == Modulus::young ? "kPa" : "mN/m"; }

constexpr const char *stiffness_label = "Stiffness E + E2D/r0",
                     *effective_label = "Effective Young's modulus of bulk, cortex and tension together";

void append(ColumnsOf<ModuliBlock>& columns, const ColumnsOf<ModuliBlock>& more) {
  columns.insert(columns.end(), more.begin(), more.end());
}

}  // namespace

ColumnsOf<ModuliBlock> estimate_columns() {
  ColumnsOf<ModuliBlock> columns;
  for (const NamedModulus& m : moduli()) {
    const auto column = [&](const std::string& ending, const std::string& label, int digits) {
      const std::string name = m.quantity + "_" + m.unit + ending;
      return ColumnDescription{.name = name, .unit = unit_text(m), .sentence = label, .digits = digits};
    };
    columns.push_back({column("", m.label, digits_of_values),
                       of_estimates([which = m.modulus](const ModuliEstimate& e) { return e.value(which); })});
    columns.push_back({column("_error", "standard error of it", digits_of_errors),
                       of_estimates([which = m.modulus](const ModuliEstimate& e) { return e.error(which); })});
  }
  append(
      columns,
      {{{.name = "stiffness_kPa", .unit = "kPa", .sentence = stiffness_label, .digits = digits_of_values},
        of_estimates(&ModuliEstimate::stiffness_kPa)},
       {{.name = "stiffness_kPa_error", .unit = "kPa", .sentence = "standard error of it", .digits = digits_of_errors},
        of_estimates(&ModuliEstimate::stiffness_error_kPa)},
       {{.name = "effective_modulus_kPa", .unit = "kPa", .sentence = effective_label, .digits = digits_of_values},
        of_estimates(&ModuliEstimate::effective_modulus_kPa)},
       {{.name = "effective_modulus_kPa_error",
         .unit = "kPa",
         .sentence = "standard error of it",
         .digits = digits_of_errors},
        of_estimates(&ModuliEstimate::effective_modulus_error_kPa)},
       {{.name = "chi_squared",
         .sentence = "distance of the features, in units of their errors",
         .digits = digits_of_ratios},
        of_estimates(&ModuliEstimate::chi_squared)},
       {{.name = "status", .sentence = "result of the fit in words", .words = words_of_statuses()},
        of_estimates([](const ModuliEstimate& e) { return int(e.status); })}});
  return columns;
}

ColumnsOf<ModuliBlock> moduli_columns() {
  using B = ModuliBlock;
  const auto of_shape = [](auto number) { return of_each(&B::seen, number); };
  ColumnsOf<B> columns{
      {{.name = "area_um2", .unit = "um2", .digits = digits_of_values},
       of_shape([](const ShapeVector& seen) { return std::exp(seen(0)); })},
      {{.name = "deformation", .digits = digits_of_values}, of_shape([](const ShapeVector& seen) { return seen(1); })},
      {{.name = "viscosity_mPas", .unit = "mPa s", .digits = digits_of_values}, stored(&B::viscosity_mPas)}};
  append(columns, estimate_columns());
  columns.push_back({{.name = "shape_excess", .digits = digits_of_ratios}, of_each(&B::shape, &ShapeExcess::excess)});
  for (ElongationColumn& column : elongation_columns(ElongatedBy::modes)) {
    column.digits = digits_of_values;
    columns.push_back({column, column.values_in<B>()});
  }
  columns.push_back({{.name = "section_factor",
                      .sentence = "c3 over that of such a cell in the tube, where the channel is square",
                      .digits = digits_of_ratios},
                     of_estimates(&ModuliEstimate::section_factor)});
  return columns;
}

ColumnsOf<ModuliBlock> moduli_features() {
  ColumnsOf<ModuliBlock> features;
  for (const NamedModulus& m : moduli()) {
    const std::string apart = m.modulus == Modulus::young ? "_with_cortex_" : "_";
    ColumnDescription column{.name = m.quantity + apart + m.unit, .unit = unit_text(m), .label = m.label};
    column.role = column.name;
    features.push_back({column, of_estimates([which = m.modulus](const ModuliEstimate& e) {
                          return e.status == ModuliStatus::resolved ? e.value(which) : no_value;
                        })});
  }
  features.push_back({{.name = "stiffness_kPa", .unit = "kPa", .label = stiffness_label, .role = "stiffness_kPa"},
                      of_estimates(&ModuliEstimate::stiffness_kPa)});
  return features;
}

}  // namespace rheocyte
