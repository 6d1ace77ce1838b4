#include "view/recording_moduli.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string_view>

#include "case/split.h"
#include "extract/event_table.h"
#include "extract/summary_table.h"
#include "store/file_writer.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// Columns of words; a sample that is called 007 stays so.
constexpr std::array<std::string_view, 22> words{"recording",
                                                 "table",
                                                 "medium",
                                                 "viscosity_model",
                                                 "temperature",
                                                 "corrected_for_pixels",
                                                 "gates",
                                                 "area_from",
                                                 "deformation_from",
                                                 "sample",
                                                 "date",
                                                 "time",
                                                 "run_index",
                                                 "chip",
                                                 "remarks",
                                                 "shapes",
                                                 "shapes_text",
                                                 "trend_text",
                                                 "shapes_of_model",
                                                 "fitting_table",
                                                 "beside_axis_text",
                                                 "error"};

Json cell(const std::string& column, const std::string& text) {
  if (text.empty()) return nullptr;
  if (std::ranges::find(words, column) != words.end()) return text;
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end ? Json(number) : Json(text);
}

}  // namespace

Json moduli_report(const fs::path& recording, const ExtractSummary& summary) {
  const std::array<SummaryLine, 1> line{{{recording, summary, {}}}};
  std::istringstream table(summary_table(line));
  std::string names, values;
  std::getline(table, names);
  std::getline(table, values);
  const auto columns = split(names, '\t'), row = split(values, '\t');
  Json columns_json = Json::object(), lines = Json::array({in_one_line(summary)});
  for (std::size_t k = 0; k < columns.size() && k < row.size(); ++k)
    columns_json[columns[k]] = cell(columns[k], row[k]);
  for (const auto& one : shape_lines(summary.shapes)) lines.push_back(one);
  for (const auto& warning : summary.warnings) lines.push_back(warning);
  Json counts = Json::object();
  for (std::size_t k = 0; k < summary.counts.size(); ++k)
    if (summary.counts[k] > 0) counts[std::string(names_of_modulus_states[k])] = summary.counts[k];
  return {{"summary", columns_json}, {"lines", lines}, {"counts", counts}};
}

void copy_events_of_gate(const fs::path& table, const fs::path& target, std::span<const std::size_t> numbers) {
  const std::set<std::size_t> wanted(numbers.begin(), numbers.end());
  std::ifstream from(table, std::ios::binary);
  FileWriter to(target);
  std::size_t events = 0;
  bool is_head = true;
  for (std::string line; std::getline(from, line); is_head = false)
    if (is_head || line.starts_with('#') || wanted.contains(events++)) to.append(line + "\n");
  to.close();
}

}  // namespace rheocyte
