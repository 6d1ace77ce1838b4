// `rheocyte extract FILES... [-o DIR]`
// Each recording is read in a process of its own, so that a damaged one harms no other. `exit_code`: 0, 2 if a
// recording could not be used, 3 if one has no event with a modulus, 128 + signal.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/cli.h"
#include "app/commands.h"
#include "app/extract_options.h"
#include "app/recording_batch.h"
#include "case/user_error.h"
#include "extract/extract_summary.h"
#include "extract/shape_words.h"
#include "report/extract_recording.h"
#include "report/methods_text.h"
#include "report/summary_table.h"
#include "shelf/modulus_tables.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

std::string why_none(const ExtractSummary& s) {
  const auto all_are = [&](ModulusState state) { return s.counts[static_cast<std::size_t>(state)] == s.recorded; };
  if (all_are(ModulusState::no_data)) return "no event has area, deformation and viscosity";
  if (all_are(ModulusState::cut)) return "all outlines touch the edge of the picture";
  return fmt::format("all events lie outside the table {}{}", s.table, s.gates.empty() ? "" : " or the gates");
}

/// All recordings of one call.
class ExtractJob {
 public:
  explicit ExtractJob(const ExtractOptions& options)
      : options_(options),
        tasks_(tasks_of(options.batch)),
        summary_file_(summary_file(options.batch)),
        tables_(options.table, options.section) {
    check_against_tables(options, tables_);
    check_place_of_summary(summary_file_);
  }

  int run() {
    const int exit_code =
        run_batch(tasks_, options_.batch, options_.measuring.patience_s.value_or(default_patience_s), *this);
    std::error_code error;
    const bool has_place =
        !options_.batch.folder.empty() || std::filesystem::is_directory(summary_file_.parent_path(), error);
    if (!lines_.empty() && has_place) add_to_summary(summary_file_, lines_);
    if (!was_stopped(exit_code) && !options_.batch.quiet) print_methods();
    if (!was_stopped(exit_code) && !options_.batch.quiet && has_place)
      print(fmt::format("{} of {} recordings, see {}\n", done_, tasks_.size(), summary_file_.string()));
    return exit_code;
  }

  ExtractFiles files(const RecordingTask& task) const {
    const std::string suffix(companion_suffix);
    return {{task.result(suffix + ".rtdc"), task.result(suffix + ".tsv")}, !options_.no_tsv};
  }

  ExtractSummary work(const RecordingTask& task, const ExtractFiles& files, const TellProgress& report_progress) const {
    return extract_recording(task.recording, files, options_, tables_, report_progress);
  }

  bool take(const RecordingTask& task, const ExtractSummary& summary) {
    ++done_;
    const std::string name = one_line(task.recording.string(), 200);
    if (!options_.batch.quiet) {
      print(fmt::format("{}: {}\n", name, in_one_line(summary)));
      for (const auto& line : shape_lines(summary.shapes)) print(fmt::format("{}: {}\n", name, line));
      for (const auto& warning : summary.warnings) tell(fmt::format("{}: {}", name, warning));
    }
    if (summary.with_modulus() == 0) tell(fmt::format("{}: {}: {}.", name, why_none(summary), in_one_line(summary)));
    lines_.push_back({task.recording, summary, {}});
    return summary.with_modulus() > 0;
  }

  void fail(const RecordingTask& task, const std::string& sentence) {
    lines_.push_back({task.recording, {}, sentence});
  }

 private:
  /// By the first recording.
  void print_methods() const {
    const auto first = std::ranges::find(lines_, tasks_.front().recording, &SummaryLine::recording);
    if (first == lines_.end() || !first->error.empty()) return;
    if (const auto text = methods_text(first->summary); !text.empty()) print(fmt::format("methods: {}\n", text));
  }

  const ExtractOptions& options_;
  std::vector<RecordingTask> tasks_;
  std::filesystem::path summary_file_;
  ModulusTables tables_;
  std::vector<SummaryLine> lines_;
  std::size_t done_ = 0;
};

}  // namespace

void add_extract_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("extract", "Young's moduli of the cells in recordings (.rtdc)");
  command->footer(
      "For example: rheocyte extract cells.rtdc -o moduli; rheocyte extract -r recordings --medium CellCarrier");
  auto options = std::make_shared<ExtractOptions>();
  declare_extract_options(*command, *options, [options, &exit_code] {
    watch_signals(SecondSignal::waits);
    exit_code = ExtractJob(*options).run();
  });
}

}  // namespace rheocyte
