// `rheocyte moduli`: E, E2D and tension of the cells in recordings.
#include <fmt/format.h>

#include <memory>

#include "app/cli.h"
#include "app/commands.h"
#include "app/extract_options.h"
#include "app/recording_batch.h"
#include "case/user_error.h"
#include "events/recording_settings.h"
#include "extract/moduli_recording.h"
#include "report/moduli_json.h"
#include "report/moduli_text.h"
#include "store/own_file.h"
#include "store/result_files.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

/// The files of one recording while they are written.
struct ModuliFiles {
  ResultFiles all = {};
  std::filesystem::path events = {}, summary = {};
  void publish() { all.publish(); }
};

/// All recordings of one call.
class ModuliJob {
 public:
  explicit ModuliJob(const ModuliOptions& options) : options_(options), tables_(options) {}

  int run() {
    const auto tasks = tasks_of(options_.batch);
    threads_ = threads_for_each(options_.batch, tasks.size());
    return run_batch(tasks, options_.batch, options_.measuring.patience_s.value_or(default_patience_s), *this);
  }

  ModuliFiles files(const RecordingTask& task) const {
    ModuliFiles made;
    made.events = made.all.add(
        file_for(task), [place = file_for(task)] { check_replaceable(place, mark_of_events(place), Foreign::keep); });
    made.summary = made.all.add(summary_for(task), [place = summary_for(task)] {
      check_replaceable(place, mark_of_moduli_json, Foreign::keep);
    });
    return made;
  }

  ModuliSummary work(const RecordingTask& task, const ModuliFiles& files, const TellProgress& report_progress) const {
    ModuliText text(files.events);
    const ModuliSummary summary =
        moduli_of_recording(task.recording, options_, tables_, threads_, text, report_progress);
    write_for(summary_for(task), files.summary, moduli_json(task.recording, tables_.name(), summary));
    return summary;
  }

  bool take(const RecordingTask& task, const ModuliSummary& summary) const {
    const std::string name = one_line(task.recording.string(), 200);
    if (!options_.batch.quiet) {
      print(fmt::format("{}: {}, see {}\n", name, in_one_line(summary), file_for(task).string()));
      for (const auto& line : lines_of(summary)) print(fmt::format("{}: {}\n", name, line));
      for (const auto& warning : summary.warnings) tell(fmt::format("{}: {}", name, warning));
    }
    if (summary.with_stiffness() > 0) return true;
    tell(fmt::format("{}: no event {}has the shape of a cell of the table {}: {}.", name,
                     summary.gates.empty() ? "" : "inside the gates ", tables_.computed().content.spec.identifier,
                     in_one_line(summary)));
    return false;
  }

  void fail(const RecordingTask&, const std::string&) const {}

 private:
  static std::filesystem::path file_for(const RecordingTask& task) { return task.result("_moduli.tsv"); }
  static std::filesystem::path summary_for(const RecordingTask& task) { return task.result("_moduli.json"); }

  const ModuliOptions& options_;
  ModuliTables tables_;
  int threads_ = 1;  ///< for each recording
};

}  // namespace

void add_moduli_command(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("moduli", "bulk and cortex moduli of the cells in recordings (.rtdc) from their contours");
  command->footer("For example: rheocyte moduli cells.rtdc -o moduli");
  auto options = std::make_shared<ModuliOptions>();
  declare_batch_options(*command, options->batch);
  declare_jobs(*command, options->batch,
               "number of recordings read in parallel; threads for one recording if there are fewer recordings");
  command
      ->add_option(
          "--table", options->table,
          "table of cells with bulk and cortex: folder of `rheocyte table` (examples/tables/combined.toml), file "
          "combined_*.cbor, or identifier of a table of the program; default: HC-2D-NH-26 (elongated cells)")
      ->type_name("TABLE");
  declare_settings(*command, settings_of(*options));
  command->callback([options, &exit_code] {
    check_options(options->measuring);
    watch_signals(SecondSignal::waits);
    exit_code = ModuliJob(*options).run();
  });
}

}  // namespace rheocyte
