#include "report/population_companion.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "events/companion_origin.h"
#include "events/event_pass.h"
#include "experiment/recording_report.h"
#include "measurement/companion_file.h"
#include "report/population_columns.h"

namespace rheocyte {
namespace {

constexpr std::size_t events_per_block = 65536;

/// Those with a role, by which a feature is described.
Columns<ShrunkenEvent> described_columns() {
  Columns<ShrunkenEvent> columns = shrunken_columns();
  std::erase_if(columns, [](const auto& column) { return column.role.empty(); });
  return columns;
}

/// Of each event of the recording, in its order.
std::vector<double> values_of(std::span<const ShrunkenEvent> shrunken, const Column<ShrunkenEvent>& column,
                              std::size_t events) {
  std::vector<double> values(events, no_value);
  for (const ShrunkenEvent& each : shrunken)
    if (each.event <= events) values[each.event - 1] = std::get<double>(column.value(each));
  return values;
}

}  // namespace

std::string write_population_companion(const std::filesystem::path& scratch, const RecordingReport& report,
                                       const TellProgress& on_progress) {
  Recording recording(report.recording);
  const auto described = described_columns();
  const auto shrunken = shrunken_events(report);
  std::vector<std::string> names = free_features(recording);
  names.resize(std::min(names.size(), described.size()));
  CompanionFile companion(scratch, recording, program());
  std::vector<std::vector<double>> columns;
  for (std::size_t k = 0; k < names.size(); ++k) {
    companion.add_feature(names[k]);
    describe_feature(companion, names[k], described[k].role, described[k].sentence);
    columns.push_back(values_of(shrunken, described[k], recording.events()));
  }
  companion.add_user_metadata("rheocyte table", report.table);
  add_origin(companion, "population", recording, std::filesystem::absolute(scratch).parent_path(), report.settings);
  EventPass pass(recording, on_progress);
  pass.in_blocks(events_per_block, [&](std::size_t first, std::size_t count) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      companion.write(names[k], first, std::span(columns[k]).subspan(first, count));
  });
  companion.close();
  std::string missing;
  for (std::size_t k = names.size(); k < described.size(); ++k)
    missing += fmt::format("{}{}", missing.empty() ? "" : ", ", described[k].role);
  return missing;
}

}  // namespace rheocyte
