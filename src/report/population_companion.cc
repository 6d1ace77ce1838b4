#include "report/population_companion.h"

#include <span>
#include <vector>

#include "case/joined.h"
#include "events/event_pass.h"
#include "experiment/recording_report.h"
#include "report/companion_writer.h"
#include "report/population_columns.h"

namespace rheocyte {
namespace {

constexpr std::size_t events_per_block = 65536;

/// Of each event of the recording, in its order; empty of a column that is not in the companion.
std::vector<double> values_of(std::span<const ShrunkenEvent> shrunken, const Column<ShrunkenEvent>& column,
                              std::size_t events) {
  if (column.role.empty()) return {};
  std::vector<double> values(events, no_value);
  for (const ShrunkenEvent& each : shrunken)
    if (each.event <= events) values[each.event - 1] = std::get<double>(column.value(each));
  return values;
}

}  // namespace

std::string write_population_companion(const std::filesystem::path& scratch, const RecordingReport& report,
                                       const TellProgress& on_progress) {
  Recording recording(report.recording);
  const auto shrunken = shrunken_events(report);
  const auto& columns = shrunken_columns();
  std::vector<std::vector<double>> values;
  for (const auto& column : columns) values.push_back(values_of(shrunken, column, recording.events()));
  CompanionWriter companion(scratch, recording);
  companion.add({columns.begin(), columns.end()});
  companion.add_metadata("rheocyte table", report.table);
  companion.add_origin("population", std::filesystem::absolute(scratch).parent_path(), report.settings);
  EventPass pass(recording, on_progress);
  std::vector<std::span<const double>> block(values.size());
  pass.in_blocks(events_per_block, [&](std::size_t first, std::size_t count) {
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!values[k].empty()) block[k] = std::span(values[k]).subspan(first, count);
    companion.write(first, block);
  });
  companion.close();
  return joined(companion.missing(), ", ");
}

}  // namespace rheocyte
