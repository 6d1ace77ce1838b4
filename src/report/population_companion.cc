#include "report/population_companion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "events/companion_origin.h"
#include "events/event_pass.h"
#include "experiment/recording_report.h"
#include "measurement/companion_file.h"

namespace rheocyte {
namespace {

constexpr std::size_t events_per_block = 65536;

struct ShrunkenColumn {
  const char *role, *meaning;
  double (*value)(const ShrunkenCell&);
};
constexpr std::array shrunken_columns{
    ShrunkenColumn{
        "shrunken modulus",
        "Young's modulus (kPa) of the event as one of the fitted population: drawn to its mean, for pictures "
        "and never for tests",
        [](const ShrunkenCell& cell) { return std::exp(cell.log_modulus); }},
    ShrunkenColumn{"sd of ln modulus", "standard deviation of the natural logarithm of the shrunken modulus",
                   [](const ShrunkenCell& cell) { return cell.modulus_deviation; }},
    ShrunkenColumn{"shrunken radius", "radius (um) of the undeformed cell as one of the fitted population",
                   [](const ShrunkenCell& cell) { return std::exp(cell.log_radius); }},
    ShrunkenColumn{"sd of ln radius", "standard deviation of the natural logarithm of the shrunken radius",
                   [](const ShrunkenCell& cell) { return cell.radius_deviation; }}};

/// Of each event of the recording, in its order.
std::vector<double> values_of(const RecordingReport& report, const ShrunkenColumn& column, std::size_t events) {
  std::vector<double> values(events, no_value);
  for (std::size_t k = 0; k < report.shrunken_events.size(); ++k)
    if (const std::size_t number = report.shrunken_events[k]; number <= events)
      values[number - 1] = column.value(report.fitted.shrunken[k]);
  return values;
}

}  // namespace

std::string write_population_companion(const std::filesystem::path& scratch, const RecordingReport& report,
                                       const TellProgress& on_progress) {
  Recording recording(report.recording);
  std::vector<std::string> names = free_features(recording);
  names.resize(std::min(names.size(), shrunken_columns.size()));
  CompanionFile companion(scratch, recording, program());
  std::vector<std::vector<double>> columns;
  for (std::size_t k = 0; k < names.size(); ++k) {
    companion.add_feature(names[k]);
    describe_feature(companion, names[k], shrunken_columns[k].role, shrunken_columns[k].meaning);
    columns.push_back(values_of(report, shrunken_columns[k], recording.events()));
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
  for (std::size_t k = names.size(); k < shrunken_columns.size(); ++k)
    missing += fmt::format("{}{}", missing.empty() ? "" : ", ", shrunken_columns[k].role);
  return missing;
}

}  // namespace rheocyte
