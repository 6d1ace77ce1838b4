#include "view/recording_moduli.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "extract/shape_words.h"
#include "report/rows_json.h"
#include "report/summary_columns.h"
#include "store/file_writer.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

}  // namespace

Json moduli_report(const fs::path& recording, const ExtractSummary& summary) {
  Json columns{{"recording", recording.string()}}, lines = Json::array({in_one_line(summary)});
  columns.update(printed_row_json(summary_columns(), summary));
  for (const auto& one : shape_lines(summary.shapes)) lines.push_back(one);
  for (const auto& warning : summary.warnings) lines.push_back(warning);
  Json counts = Json::object();
  for (std::size_t k = 0; k < summary.counts.size(); ++k)
    if (summary.counts[k] > 0) counts[std::string(names_of_modulus_states[k])] = summary.counts[k];
  return {{"summary", columns}, {"lines", lines}, {"counts", counts}};
}

void ModuliCompanion::begin(const Recording& recording, const std::vector<std::string>&) {
  companion_.emplace(file_, recording);
  companion_->add(descriptions(values_.columns()));
}

void ModuliCompanion::take(std::size_t first, const ModuliBlock& block) { companion_->write(first, values_.of(block)); }

void ModuliCompanion::end(const std::vector<std::string>&) { companion_->close(); }

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
