#include "app/command_extract.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <system_error>

#include "app/exit_codes.h"
#include "app/extract_options.h"
#include "case/user_error.h"
#include "extract/extract_recording.h"
#include "extract/extract_summary.h"
#include "extract/modulus_tables.h"
#include "extract/recording_list.h"
#include "store/contained.h"
#include "store/contained_sentence.h"
#include "store/own_file.h"
#include "store/recording_progress.h"
#include "store/standard_error.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;
using Kind = ContainedEnd::Kind;

void make_folder_for(const fs::path& file) {
  std::error_code error;
  if (!file.has_parent_path() || fs::is_directory(file.parent_path(), error)) return;
  fs::create_directories(file.parent_path(), error);
  if (error)
    throw UserError(fmt::format("{}: the folder cannot be made ({}).", one_line(file.parent_path().string(), 300),
                                error.message()));
}

/// All recordings of one call.
class Batch {
 public:
  explicit Batch(const ExtractOptions& options)
      : options_(options),
        tasks_(list_recordings(options.batch)),
        summary_file_(summary_file(options.batch, tasks_)),
        tables_(options.table) {
    if (options.no_area_correction && !tables_.own())
      throw UserError(fmt::format(
          "rheocyte: --no-area-correction and --table {} contradict each other; published tables are used with areas "
          "as measured always.",
          one_line(options.table, 200)));
  }

  int run() {
    for (const auto& task : tasks_) {
      make_folder_for(task.output.companion);
      if (!take(task)) return exit_signal + signal_received();
    }
    write_own_file(summary_file_, summary_table(lines_), "recording\tevents\tvalid\t", Foreign::keep);
    if (!options_.batch.quiet)
      fmt::print("{} of {} recordings, see {}\n", done_, tasks_.size(), summary_file_.string());
    return failed_ ? exit_user_error : empty_ ? exit_numerical : exit_converged;
  }

 private:
  // False if the user wants to stop.
  bool take(const RecordingTask& task) {
    RecordingProgress progress(task.recording, options_.batch.quiet);
    Containment limits;
    limits.patience_s = options_.measuring.patience_s;
    const auto work = [&](const TellProgress& tell_progress) {
      return to_json(extract_recording(task.recording, task.output, options_, tables_, tell_progress));
    };
    const ContainedEnd end = run_contained(work, limits, [&](double fraction) { progress(fraction); });
    if (end.kind == Kind::finished) {
      take_summary(task, summary_from_json(end.text));
    } else {
      std::error_code ignored;
      for (const auto& file : {task.output.companion, task.output.events}) fs::remove(unfinished(file), ignored);
      if (end.kind == Kind::stopped) return false;
      failed_ = true;
      lines_.push_back({task.recording, {}, sentence_for(task.recording, end, options_.measuring.patience_s)});
      tell(lines_.back().error);
    }
    return true;
  }

  void take_summary(const RecordingTask& task, const ExtractSummary& summary) {
    ++done_;
    const std::string name = one_line(task.recording.string(), 200);
    if (!options_.batch.quiet) {
      fmt::print("{}: {}\n", name, in_one_line(summary));
      for (const auto& warning : summary.warnings) tell(fmt::format("{}: {}", name, warning));
    }
    if (summary.valid() == 0) {
      empty_ = true;
      tell(fmt::format("{}: all events lie outside the table {}{}: {}.", name, summary.table,
                       summary.gates.empty() ? "" : " or the gates", in_one_line(summary)));
    }
    lines_.push_back({task.recording, summary, {}});
  }

  const ExtractOptions& options_;
  std::vector<RecordingTask> tasks_;
  fs::path summary_file_;
  ModulusTables tables_;
  std::vector<SummaryLine> lines_;
  std::size_t done_ = 0;
  bool failed_ = false, empty_ = false;
};

}  // namespace

void add_extract_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("extract", "Young's moduli of the cells in recordings (.rtdc)");
  auto options = std::make_shared<ExtractOptions>();
  declare_extract_options(*command, *options, [options, &exit_code] {
    watch_signals();
    exit_code = Batch(*options).run();
  });
}

}  // namespace rheocyte
