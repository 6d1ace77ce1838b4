// The file of a table of elongated cells.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "numeric/fingerprint.h"
#include "table/checked_record.h"
#include "table/elongated_table.h"
#include "table/origin_record.h"

namespace rheocyte {

namespace {

using nlohmann::json;

constexpr RecordKind elongated_kind{"rheocyte elongated cells", "1", "table of elongated cells",
                                    "`rheocyte table` with the table's spec writes it again"};
constexpr const char* at_rest_key = "are_long_at_rest";  // only of those
constexpr int fewest_nodes = 4, max_nodes = 100;
constexpr double largest_ratio = 10;  // tensions over moduli are far below

int count_of(const json& record, const char* key) {
  const int count = record.at(key);
  check_record(count >= fewest_nodes && count <= max_nodes, "a size is out of range");
  return count;
}

std::vector<double> ascending(const json& record, const char* key, const char* count) {
  auto values = numbers_of(record, key, std::size_t(count_of(record, count)));
  check_record(std::ranges::all_of(values, [](double v) { return std::isfinite(v); }) &&
                   std::ranges::adjacent_find(values, std::ranges::greater_equal()) == values.end(),
               "its cells are not in order");
  return values;
}

/// Moduli fall along each branch.
void check_moduli(const ElongatedContent& content) {
  const auto states = std::size_t(content.states);
  for (std::size_t k = 0; k < content.modulus_kPa.size(); ++k) {
    const double modulus = content.modulus_kPa[k];
    check_record(modulus > 0 && std::isfinite(modulus), "a modulus is out of range");
    check_record(k % states == 0 || modulus < content.modulus_kPa[k - 1], "the modulus does not fall along a branch");
  }
}

ElongatedContent content_from(const json& record) {
  ElongatedContent content;
  content.origin = origin_from(record);
  content.radii_um = ascending(record, "radii_um", "count_of_radii");
  content.axial_ratios = ascending(record, "axial_ratios", "count_of_axial_ratios");
  content.elongation = record.contains(at_rest_key) ? Elongation::by_rest_shape : Elongation::by_tension;
  content.states = count_of(record, "states");
  check_record(content.radii_um.front() > 0 && content.radii_um.back() < content.origin.flow.width_um / 2,
               "a radius is out of range");
  check_record(content.axial_ratios.front() > -largest_ratio && content.axial_ratios.back() < largest_ratio,
               "a tension is out of range");
  const std::size_t all = content.branch(content.radii_um.size(), 0);
  content.modulus_kPa = numbers_of(record, "modulus_kPa", all);
  check_moduli(content);
  const json& values = record.at("values");
  check_record(values.is_array() && values.size() == content.value.size(), "its measures are others");
  constexpr double largest = 100;
  for (std::size_t m = 0; m < content.value.size(); ++m) {
    content.value[m] = numbers_of(json{{"value", values[m]}}, "value", all);
    check_record(std::ranges::all_of(content.value[m], [](double v) { return std::abs(v) < largest; }),
                 "a number is not one that cells have");
  }
  content.error = record.at("error");
  check_record(content.error >= 0 && content.error < 1, "its error is out of range");
  return content;
}

}  // namespace

std::string to_bytes(const ElongatedContent& content) {
  json values = json::array();
  for (const auto& value : content.value) values.push_back(blob_of(value));
  json record = {{"radii_um", blob_of(content.radii_um)},
                 {"count_of_radii", content.radii_um.size()},
                 {"axial_ratios", blob_of(content.axial_ratios)},
                 {"count_of_axial_ratios", content.axial_ratios.size()},
                 {"states", content.states},
                 {"modulus_kPa", blob_of(content.modulus_kPa)},
                 {"values", std::move(values)},
                 {"error", content.error}};
  if (content.elongation == Elongation::by_rest_shape) record[at_rest_key] = true;
  put_origin(content.origin, record);
  return sealed_record(elongated_kind, fingerprint(content.origin.spec), record);
}

ElongatedContent elongated_from_bytes(std::string_view bytes, const std::string& name) {
  return read_or_refuse(elongated_kind, name,
                        [&] { return content_from(opened_record(elongated_kind, bytes).record); });
}

std::string elongated_file_name(const std::string& identifier) { return fmt::format("elongated_{}.cbor", identifier); }

}  // namespace rheocyte
