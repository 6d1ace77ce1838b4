#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "analytic/effective_modulus.h"
#include "case/scales.h"
#include "case/write_case.h"
#include "result/result.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
using Key = Field<Result, Json>;
using BranchKey = Field<StepOfResult, Json>;

#ifdef __clang__
constexpr const char* compiler = "Clang " __clang_version__;
#else
constexpr const char* compiler = "GCC " __VERSION__;
#endif

// A modulus on the way to the requested one; null if there is none or the cell is rigid.
Json over(const std::optional<double>& modulus, double compliance) {
  return modulus && compliance > 0 ? Json(*modulus / compliance) : Json(nullptr);
}

Json branch(const Result& result) {
  Json steps = Json::array();
  for (const auto& step : result.state.branch) steps.push_back(object_of(branch_fields(), StepOfResult{result, step}));
  return steps;
}

Json errors_of(const Result& result) {
  Json json = Json::object();
  for (const auto& measure : state_measures) json[measure.name] = measure.physical(result.state.errors, result.scales);
  return json;
}

Json gradients_of(const Result& result) {
  Json json = Json::object();
  for (const Gradient& gradient : result.gradients)
    for (std::size_t i = 0; i < std::size(state_measures); ++i)
      json[gradient.key][state_measures[i].name] = gradient.measures(Eigen::Index(i));
  return json;
}

bool is_sound(const StateMeasure& measure, const StateNumbers& numbers) {
  const double value = measure.value(numbers);
  return std::isfinite(value) || (std::isnan(value) && !measure.null_where.empty());
}

bool all_sound(const Result& result) {
  const auto& state = result.state;
  const bool by_error = result.input.time.scheme == TimeScheme::stationary;
  return std::ranges::all_of(state_measures, [&](const StateMeasure& m) { return is_sound(m, state); }) &&
         (!by_error || (std::isfinite(state.residual) && std::isfinite(state.estimated_error)));
}

}  // namespace

std::span<const Field<Result, Json>> outcome_fields() {
  static constexpr Key fields[] = {
      {"program", "always rheocyte", [](const Result&) -> Json { return "rheocyte"; }},
      {"version", "of the program", [](const Result&) -> Json { return version; }},
      {"status",
       "\"converged\": the last state is the requested one, its stability_margin is not negative, its estimated_error "
       "not above the accuracy of the case; else the name of the reason why not. \"error-unknown\": the last state is "
       "the requested one, but a signal stopped the computation of its error",
       [](const Result& r) -> Json { return name(r.state.outcome.status); }},
      {"message", "the same in a sentence: what, where, what to try",
       [](const Result& r) -> Json { return r.state.outcome.message; }},
      {"reached", "requested moduli over those of the state; below 1: the last state on the way to the requested one",
       [](const Result& r) -> Json { return r.state.outcome.reached; }},
      {"young_modulus_reached_kPa", "Young's modulus of the state; null without an elastic interior",
       [](const Result& r) { return over(r.input.cell.bulk.young_modulus_kPa, r.state.outcome.reached); }},
      {"cortex_modulus_reached_mN_per_m", "modulus of its cortex; null without an elastic cortex",
       [](const Result& r) { return over(r.input.cell.cortex.modulus_mN_per_m, r.state.outcome.reached); }},
      {"tension_mN_per_m", "requested surface tension of the cell, given or a fraction of the cortex modulus",
       [](const Result& r) -> Json { return tension_mN_per_m(r.input); }},
      {"effective_modulus_kPa",
       "Young's modulus of the homogeneous solid that a small axial tension elongates as much as the requested cell, "
       "with its bulk, its cortex, its surface tension and its bending stiffness (docs/theory-analytic.md, "
       "eq:effective-modulus); null for a cell with a rest_aspect",
       [](const Result& r) -> Json { return effective_modulus_kPa(r); }}};
  return fields;
}

std::span<const Field<Result, Json>> computation_fields() {
  static constexpr Key fields[] = {
      {"unknowns", "of the finest system", [](const Result& r) -> Json { return r.state.statistics.unknowns; }},
      {"newton_iterations", "over all steps and meshes",
       [](const Result& r) -> Json { return r.state.statistics.newton_iterations; }},
      {"residual", "of the last Newton iteration, relative to the driving forces",
       [](const Result& r) -> Json { return r.state.residual; }},
      {"estimated_error",
       "of the deformation, relative to it or to deformation_floor where that is larger; of the motion with "
       "numerics.accuracy_of = \"motion\"; null for a state on the way; in time the distance from the stationary shape "
       "once the cell has settled, else from the same run with other steps and on another mesh",
       [](const Result& r) -> Json { return r.state.estimated_error; }},
      {"deformation_floor",
       "errors of smaller deformations are relative to this one: 1e-12 over the requested accuracy on the axis "
       "(rounding), 1e-4 off the axis (below the resolution of recordings), time.accuracy over time.mesh_accuracy in "
       "time, at most 0.01",
       [](const Result& r) -> Json { return r.state.deformation_floor; }},
      {"errors",
       "estimated errors of the measures above, absolute, each under the name and in the unit of its measure; null for "
       "a state on the way, and where there is no measure or nothing to compare with",
       errors_of},
      {"gradients",
       "derivatives of the measures above with respect to the numbers of the case that were asked for (solve "
       "--gradient), by keys of the case and names of measures, each in the unit of the measure over that of the key; "
       "those of the numbers as they are computed, on their mesh; else empty",
       gradients_of},
      {"wall_time_s", "time that the solver took", [](const Result& r) -> Json { return r.state.statistics.total_s; }},
      {"case", "the complete case with its defaults; its keys are those of the case reference",
       [](const Result& r) { return to_json(r.input); }},
      {"case_hash", "equal for equal cases", [](const Result& r) -> Json { return case_hash(r.input); }},
      {"branch", "steps from the rigid cell to the state, a list; empty in time", branch},
      {"statistics", "sizes and times of the solver",
       [](const Result& r) { return object_of(statistics_fields(), r.state.statistics); }},
      {"compiler", "that built the program", [](const Result&) -> Json { return compiler; }},
      {"threads", "of the machine", [](const Result& r) { return object_of(thread_fields(), r); }}};
  return fields;
}

std::span<const Field<StepOfResult, Json>> branch_fields() {
  static constexpr BranchKey fields[] = {
      {"compliance", "requested modulus over that of the step: 0 is rigid, 1 the requested state",
       [](const StepOfResult& s) -> Json { return s.step.compliance; }},
      {"young_modulus_kPa", "Young's modulus of the step; null: rigid, or there is none",
       [](const StepOfResult& s) { return over(s.result.input.cell.bulk.young_modulus_kPa, s.step.compliance); }},
      {"cortex_modulus_mN_per_m", "modulus of its cortex in the same step; null: rigid, or there is none",
       [](const StepOfResult& s) { return over(s.result.input.cell.cortex.modulus_mN_per_m, s.step.compliance); }},
      {"deformation", "as above", [](const StepOfResult& s) -> Json { return s.step.deformation; }},
      {"newton_iterations", "of the step", [](const StepOfResult& s) -> Json { return s.step.newton_iterations; }},
      {"degree", "polynomial degree at which the state was found",
       [](const StepOfResult& s) -> Json { return s.step.degree; }}};
  return fields;
}

std::span<const Field<SolveStatistics, Json>> statistics_fields() {
  using S = SolveStatistics;
  static constexpr Field<S, Json> fields[] = {
      {"degree", "polynomial degree of the finest system", [](const S& s) -> Json { return s.degree; }},
      {"elements", "of the finest mesh", [](const S& s) -> Json { return s.elements; }},
      {"factorisations", "of Newton's matrix", [](const S& s) -> Json { return s.factorisations; }},
      {"continuation_steps", "steps in stiffness, or in time", [](const S& s) -> Json { return s.continuation_steps; }},
      {"assembly_s", "time for integrals over elements, added over the threads",
       [](const S& s) -> Json { return s.assembly_s; }},
      {"factorisation_s", "time for factorisations, those within elements included, added over the threads",
       [](const S& s) -> Json { return s.factorisation_s; }},
      {"substitution_s", "time for solutions with the factors", [](const S& s) -> Json { return s.substitution_s; }},
      {"total_s", "as wall_time_s", [](const S& s) -> Json { return s.total_s; }}};
  return fields;
}

std::span<const Field<Result, Json>> thread_fields() {
  static constexpr Key fields[] = {
      {"processors", "of the machine", [](const Result&) -> Json { return std::thread::hardware_concurrency(); }}};
  return fields;
}

double effective_modulus_kPa(const Result& result) {
  const double one = dimensionless_one(unit_of("effective_modulus_kPa"), result.scales);
  return effective_modulus(result.problem, result.problem.radius_ratio) * one;
}

void refuse_unfinite_numbers(Result& result) {
  Outcome& outcome = result.state.outcome;
  if (outcome.status != Status::converged || all_sound(result)) return;
  outcome.status = Status::not_finite;
  outcome.message = "The computation ended with a number that is not finite; please report the case.";
}

// nlohmann::json writes null for a number that is not finite.
Json to_json(const Result& result) {
  Json json = object_of(outcome_fields(), result);
  for (const auto& measure : state_measures) json[measure.name] = measure.physical(result.state, result.scales);
  json.update(object_of(computation_fields(), result));
  return json;
}

}  // namespace rheocyte
