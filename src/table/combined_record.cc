// A combined table as one file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "table/checked_record.h"
#include "table/combined_table.h"

namespace rheocyte {

namespace {

using nlohmann::json;

constexpr RecordKind combined_kind{"rheocyte combined cells", "1", "combined table",
                                   "`rheocyte table` with the table's spec writes it again"};
constexpr std::size_t place_numbers = 4, max_branches = 100000, max_samples = 10000;

using Features = Eigen::Matrix<double, Eigen::Dynamic, feature_count, Eigen::RowMajor>;

json record_of_branch(const CombinedBranch& branch) {
  const auto& [radius, fraction, ratio, axial] = branch.place;
  const Features value = branch.value, slope = branch.slope;
  return {{"place", blob_of(std::array{radius, fraction, ratio, axial})},
          {"samples", branch.samples()},
          {"stiffness_kPa", blob_of(branch.stiffness_kPa)},
          {"error", blob_of(branch.error)},
          {"value", blob_of({value.data(), std::size_t(value.size())})},
          {"slope", blob_of({slope.data(), std::size_t(slope.size())})}};
}

CombinedBranch branch_in(const json& record) {
  const auto place = numbers_of(record, "place", place_numbers);
  const auto samples = record.at("samples").get<std::size_t>();
  check_record(samples > 0 && samples <= max_samples, "a number is out of range");
  const auto features = [&](const char* key) -> Eigen::MatrixXd {
    const auto numbers = numbers_of(record, key, samples * feature_count);
    return Eigen::Map<const Features>(numbers.data(), Eigen::Index(samples), feature_count);
  };
  return {{place[0], place[1], place[2], place[3]},
          numbers_of(record, "stiffness_kPa", samples),
          features("value"),
          features("slope"),
          numbers_of(record, "error", samples)};
}

CombinedTable combined_in(const OpenedRecord& opened, const std::string& name) {
  CombinedTable table{parse_table_spec(opened.record.at("spec").get<std::string>(), name), {}};
  const json& branches = opened.record.at("branches");
  check_record(table.spec.is_combined() && branches.is_array() && !branches.empty() && branches.size() <= max_branches,
               "its content does not agree with its spec");
  for (const json& record : branches) {
    const CombinedBranch& branch = table.branches.emplace_back(branch_in(record));
    const std::string_view reason = why_no_branch(branch);
    check_record(reason.empty(), reason.data());
  }
  return table;
}

}  // namespace

std::string combined_file_name(const std::string& identifier) { return fmt::format("combined_{}.cbor", identifier); }

std::string to_bytes(const CombinedTable& table) {
  json branches = json::array();
  for (const CombinedBranch& branch : table.branches) branches.push_back(record_of_branch(branch));
  return sealed_record(combined_kind, spec_hash(table.spec),
                       {{"spec", to_toml(table.spec)}, {"branches", std::move(branches)}});
}

CombinedTable combined_from_bytes(std::string_view bytes, const std::string& name) {
  return read_or_refuse(combined_kind, name, [&] { return combined_in(opened_record(combined_kind, bytes), name); });
}

}  // namespace rheocyte
