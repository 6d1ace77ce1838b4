// A branch as bytes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "case/joined.h"
#include "table/branch.h"
#include "table/checked_record.h"

namespace rheocyte {

namespace {

using nlohmann::json;

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const auto& measure : table_measures) names.emplace_back(measure.name);
  return names;
}

constexpr RecordKind branch_kind{"rheocyte branch", "2", "record of a branch", "delete it, and it is computed again"};

json blob_of_all(const std::vector<Eigen::MatrixX2d>& contours) {
  std::vector<double> all;
  for (const auto& contour : contours) all.insert(all.end(), contour.data(), contour.data() + contour.size());
  return blob_of(all);
}

json blob_of_matrix(const Eigen::MatrixXd& matrix) {
  return blob_of({matrix.data(), static_cast<std::size_t>(matrix.size())});
}

Eigen::MatrixXd matrix(const json& record, const char* key, std::size_t samples) {
  const auto values = numbers_of(record, key, samples * measure_count);
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), Eigen::Index(samples), measure_count);
}

std::vector<Eigen::MatrixX2d> contours(const json& record, const char* key, std::size_t samples) {
  const auto points = record.at("contour_points").get<std::size_t>();
  if (points > 1000000) throw DamagedRecord{"contour_points is out of range"};
  const auto values = numbers_of(record, key, samples * points * 2);
  std::vector<Eigen::MatrixX2d> all;
  for (std::size_t i = 0; i < samples; ++i)
    all.push_back(Eigen::Map<const Eigen::MatrixX2d>(values.data() + 2 * points * i, Eigen::Index(points), 2));
  return all;
}

json record_of(const SampledBranch& branch) {
  return {{"radius_um", branch.radius_um},
          {"cortex_fraction", branch.cortex_fraction},
          {"tension_ratio", branch.tension_ratio},
          {"axial_ratio", branch.axial_ratio},
          {"bending_kBT", branch.bending_kBT},
          {"samples", branch.samples()},
          {"measures", measure_names()},
          {"contour_points", branch.contour.empty() ? 0 : branch.contour.front().rows()},
          {"stiffness", blob_of(branch.stiffness)},
          {"value", blob_of_matrix(branch.value)},
          {"slope", blob_of_matrix(branch.slope)},
          {"error", blob_of(branch.error)},
          {"contour", blob_of_all(branch.contour)},
          {"contour_slope", blob_of_all(branch.contour_slope)},
          {"end_status", name(branch.end.status)},
          {"end_message", branch.end.message},
          {"solves", branch.solves},
          {"newton_iterations", branch.newton_iterations},
          {"refused", branch.refused},
          {"seconds", branch.seconds},
          {"factorisation_seconds", branch.factorisation_seconds}};
}

/// What tables are made of is finite; a measure that a state does not have is not a number.
void check_numbers(const SampledBranch& branch) {
  const auto all_finite = [](const std::vector<Eigen::MatrixX2d>& contours) {
    return std::ranges::all_of(contours, [](const auto& contour) { return contour.allFinite(); });
  };
  const auto is_sound = [](double v) { return std::isfinite(v) && v >= 0; };
  check_record(std::ranges::all_of(branch.stiffness, is_sound) && std::ranges::all_of(branch.error, is_sound) &&
                   all_finite(branch.contour) && all_finite(branch.contour_slope),
               "a number is out of range");
  check_record(std::ranges::adjacent_find(branch.stiffness, std::ranges::less_equal()) == branch.stiffness.end(),
               "the stiffness does not fall along the branch");
}

SampledBranch branch_of(const json& record) {
  if (record.at("measures") != json(measure_names())) throw DamagedRecord{"it holds other measures"};
  const auto samples = record.at("samples").get<std::size_t>();
  if (samples > 1000000) throw DamagedRecord{"samples is out of range"};
  SampledBranch branch;
  branch.radius_um = record.at("radius_um");
  branch.cortex_fraction = record.value("cortex_fraction", record.value("cortex_share", 0.0));  // of before 0.4
  branch.tension_ratio = record.value("tension_ratio", 0.0);
  branch.axial_ratio = record.value("axial_ratio", 0.0);
  branch.bending_kBT = record.at("bending_kBT");
  branch.stiffness = numbers_of(record, "stiffness", samples);
  branch.value = matrix(record, "value", samples);
  branch.slope = matrix(record, "slope", samples);
  branch.error = numbers_of(record, "error", samples);
  branch.contour = contours(record, "contour", samples);
  branch.contour_slope = contours(record, "contour_slope", samples);
  const auto end = status_named(record.at("end_status").get<std::string>());
  if (!end) throw DamagedRecord{"the end of the branch has no known status"};
  branch.end = {*end, record.at("end_message")};
  branch.solves = record.at("solves");
  branch.newton_iterations = record.at("newton_iterations");
  branch.refused = record.at("refused");
  branch.seconds = record.at("seconds");
  branch.factorisation_seconds = record.at("factorisation_seconds");
  check_numbers(branch);
  return branch;
}

SampledBranch checked_branch(std::string_view bytes, const std::string& spec_hash) {
  const OpenedRecord opened = opened_record(branch_kind, bytes);
  if (opened.spec_hash != spec_hash) throw DamagedRecord{"it belongs to another spec"};
  return branch_of(opened.record);
}

}  // namespace

std::string branch_record_format() {
  return fmt::format("{} {}: {}", branch_kind.kind, branch_kind.format, joined(measure_names(), ", "));
}

std::string to_bytes(const SampledBranch& branch, const std::string& spec_hash) {
  return sealed_record(branch_kind, spec_hash, record_of(branch));
}

SampledBranch branch_from_bytes(std::string_view bytes, const std::string& spec_hash, const std::string& name) {
  return read_or_refuse(branch_kind, name, [&] { return checked_branch(bytes, spec_hash); });
}

}  // namespace rheocyte
