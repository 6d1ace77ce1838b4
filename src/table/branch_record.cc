// A branch as bytes: an outer CBOR object with the checksum of an inner one, which holds numbers as raw doubles.
#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include "case/user_error.h"
#include "case/write_case.h"
#include "table/branch.h"

namespace rheocyte {

namespace {

static_assert(std::endian::native == std::endian::little, "records hold little-endian numbers");

using nlohmann::json;

constexpr std::string_view kind = "rheocyte branch", format = "1";

struct Damaged {
  std::string what;
};

json blob(const double* data, Eigen::Index size) {
  std::vector<std::uint8_t> bytes(std::size_t(size) * sizeof(double));
  if (size > 0) std::memcpy(bytes.data(), data, bytes.size());
  return json::binary(std::move(bytes));
}

json blob(const std::vector<double>& values) { return blob(values.data(), Eigen::Index(values.size())); }

json blob(const std::vector<Eigen::MatrixX2d>& contours) {
  std::vector<double> all;
  for (const auto& contour : contours) all.insert(all.end(), contour.data(), contour.data() + contour.size());
  return blob(all);
}

std::vector<double> numbers(const json& record, const char* key, std::size_t size) {
  const auto& bytes = record.at(key).get_binary();
  if (bytes.size() != size * sizeof(double)) throw Damaged{fmt::format("{} has another length", key)};
  std::vector<double> values(size);
  if (size > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

Eigen::MatrixXd matrix(const json& record, const char* key, std::size_t samples) {
  const auto values = numbers(record, key, samples * measure_count);
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), Eigen::Index(samples), measure_count);
}

std::vector<Eigen::MatrixX2d> contours(const json& record, const char* key, std::size_t samples) {
  const auto points = record.at("contour_points").get<std::size_t>();
  if (points > 1000000) throw Damaged{"contour_points is out of range"};
  const auto values = numbers(record, key, samples * points * 2);
  std::vector<Eigen::MatrixX2d> all;
  for (std::size_t i = 0; i < samples; ++i)
    all.push_back(Eigen::Map<const Eigen::MatrixX2d>(values.data() + 2 * points * i, Eigen::Index(points), 2));
  return all;
}

json record_of(const SampledBranch& branch) {
  return {{"radius_um", branch.radius_um},
          {"cortex_share", branch.cortex_share},
          {"tension_ratio", branch.tension_ratio},
          {"bending_kBT", branch.bending_kBT},
          {"samples", branch.samples()},
          {"measures", measure_names},
          {"contour_points", branch.contour.empty() ? 0 : branch.contour.front().rows()},
          {"stiffness", blob(branch.stiffness)},
          {"value", blob(branch.value.data(), branch.value.size())},
          {"slope", blob(branch.slope.data(), branch.slope.size())},
          {"error", blob(branch.error)},
          {"contour", blob(branch.contour)},
          {"contour_slope", blob(branch.contour_slope)},
          {"end_status", branch.end.status},
          {"end_message", branch.end.message},
          {"solves", branch.solves},
          {"newton_iterations", branch.newton_iterations},
          {"refused", branch.refused},
          {"seconds", branch.seconds},
          {"factorisation_seconds", branch.factorisation_seconds}};
}

SampledBranch branch_of(const json& record) {
  if (record.at("measures") != json(measure_names)) throw Damaged{"it holds other measures"};
  const auto samples = record.at("samples").get<std::size_t>();
  if (samples > 1000000) throw Damaged{"samples is out of range"};
  SampledBranch branch;
  branch.radius_um = record.at("radius_um");
  branch.cortex_share = record.value("cortex_share", 0.0);
  branch.tension_ratio = record.value("tension_ratio", 0.0);
  branch.bending_kBT = record.at("bending_kBT");
  branch.stiffness = numbers(record, "stiffness", samples);
  branch.value = matrix(record, "value", samples);
  branch.slope = matrix(record, "slope", samples);
  branch.error = numbers(record, "error", samples);
  branch.contour = contours(record, "contour", samples);
  branch.contour_slope = contours(record, "contour_slope", samples);
  branch.end = {record.at("end_status"), record.at("end_message")};
  branch.solves = record.at("solves");
  branch.newton_iterations = record.at("newton_iterations");
  branch.refused = record.at("refused");
  branch.seconds = record.at("seconds");
  branch.factorisation_seconds = record.at("factorisation_seconds");
  return branch;
}

std::string as_text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

std::string envelope(const std::vector<std::uint8_t>& record, const std::string& spec_hash) {
  return as_text(json::to_cbor(json{{"kind", kind},
                                    {"format", format},
                                    {"spec", spec_hash},
                                    {"checksum", fingerprint(as_text(record) + spec_hash)},
                                    {"record", json::binary(record)}}));
}

SampledBranch checked_branch(std::string_view bytes, const std::string& spec_hash) {
  const json outer = json::from_cbor(bytes.begin(), bytes.end());
  if (outer.at("kind") != kind) throw Damaged{"it is no record of a branch"};
  if (outer.at("format") != format) throw Damaged{"it was written by another version"};
  const std::vector<std::uint8_t> record = outer.at("record").get_binary();
  const std::string spec = outer.at("spec");
  if (envelope(record, spec) != bytes) throw Damaged{"its checksum is wrong"};
  if (spec != spec_hash) throw Damaged{"it belongs to another spec"};
  return branch_of(json::from_cbor(record));
}

}  // namespace

std::string to_bytes(const SampledBranch& branch, const std::string& spec_hash) {
  return envelope(json::to_cbor(record_of(branch)), spec_hash);
}

SampledBranch branch_from_bytes(std::string_view bytes, const std::string& spec_hash, const std::string& name) {
  std::string what = "it is cut or damaged";
  try {
    return checked_branch(bytes, spec_hash);
  } catch (const Damaged& damage) {
    what = damage.what;
  } catch (const json::exception&) {
  } catch (const std::length_error&) {
  } catch (const std::bad_alloc&) {
  }
  throw UserError(
      fmt::format("{}: this record of a branch cannot be used: {}; delete it, and it is computed again.", name, what));
}

}  // namespace rheocyte
