// `rheocyte time-course`: Young's modulus and viscosity of the cells in recordings, from how the third mode of their
// outlines changes along the channel.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/cli.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/extract_options.h"
#include "app/recording_batch.h"
#include "case/user_error.h"
#include "events/recording_settings.h"
#include "extract/course_events.h"
#include "report/time_course_table.h"
#include "shelf/shipped_tables.h"
#include "store/isolated.h"
#include "store/own_file.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"
#include "store/watch.h"

namespace rheocyte {

namespace {

CourseEvents read(const RecordingTask& task, const TimeCourseOptions& options) {
  return read_isolated(task.recording, options.measuring, watch_of(task.recording, options.batch.quiet),
                       [&](const TellProgress& report_progress) {
                         return read_course_events(task.recording, options.measuring, report_progress);
                       });
}

double contraction_of(const TimeCourseOptions& options, std::size_t recording, std::size_t recordings) {
  const auto& places = options.contraction_um;
  if (places.size() == 1) return places.front();
  if (places.size() == recordings) return places[recording];
  throw UserError(
      fmt::format("rheocyte: --contraction-um has {} places for {} recordings; give one for all, or one "
                  "each.",
                  places.size(), recordings));
}

int run(const TimeCourseOptions& options) {
  const auto tasks = tasks_of(options.batch);
  const DynamicTable table = read_dynamic_table(dynamic_table_or_shipped(options.table));
  check_replaceable(options.file, mark_of_courses, Foreign::keep);
  CourseTable courses(table, options.section);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const double contraction_um = contraction_of(options, i, tasks.size());
    const std::string name = one_line(tasks[i].recording.string(), 200);
    const CourseEvents events = read(tasks[i], options);
    for (const std::string& warning : remarks(events)) tell(fmt::format("{}: {}", name, warning));
    courses.add(events, name, contraction_um);
  }
  const CourseReport report = courses.report(until_signal());
  replace_own_file(options.file, course_text(report), mark_of_courses, Foreign::keep);
  if (!options.batch.quiet)
    for (const std::string& line : report.lines) print(line + "\n");
  return exit_converged;
}

}  // namespace

void add_time_course_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "time-course", "Young's modulus and viscosity of cells recorded (.rtdc) at several places along the channel");
  command->footer("For example: rheocyte time-course cells.rtdc --contraction-um 0 -o course.tsv");
  auto options = std::make_shared<TimeCourseOptions>();
  command->add_option("FILES", options->batch.inputs, "recordings (.rtdc) of one population; folders with -r")
      ->required();
  command
      ->add_option("--table", options->table,
                   "dynamic table: folder of `rheocyte table` or file dynamic_*.cbor; default: HE-chip-26 (square "
                   "channel downstream of a 45-degree funnel)")
      ->type_name("TABLE");
  command
      ->add_option("--contraction-um", options->contraction_um,
                   "pos_x (um) of the end of the contraction through which the cells enter the channel; one value for "
                   "all recordings, or one for each, comma-separated")
      ->delimiter(',')
      ->required();
  command->add_option("-o,--output", options->file, "file for the table of the cells and the population")
      ->type_name("FILE.tsv")
      ->required();
  command->add_flag("-r,--recursive", options->batch.recursive, "search the given folders for recordings");
  command->add_flag("--quiet", options->batch.quiet, "print neither progress nor results");
  declare_settings(*command, settings_of(*options));
  command->callback([options, &exit_code] {
    check_options(options->measuring);
    watch_signals(SecondSignal::waits);
    exit_code = run(*options);
  });
}

}  // namespace rheocyte
