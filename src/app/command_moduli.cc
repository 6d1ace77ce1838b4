#include "app/command_moduli.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/exit_codes.h"
#include "app/extract_options.h"
#include "case/user_error.h"
#include "extract/moduli_recording.h"
#include "extract/recording_list.h"
#include "store/contained_sentence.h"
#include "store/own_file.h"
#include "store/recording_progress.h"
#include "store/standard_error.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "# rheocyte ";

/// All recordings of one call.
class Batch {
 public:
  explicit Batch(const ModuliOptions& options)
      : options_(options),
        table_(read_combined_table(options.table)),
        between_(table_),
        simulated_(conditions_of(table_.spec)) {
    if (options.fit_tension && between_.tension_ratios().size() < 2)
      throw UserError(
          fmt::format("rheocyte: --fit-tension needs a table with several tensions (table.tension_ratio); {} "
                      "has one.",
                      table_.spec.identifier));
  }

  int run() {
    for (const auto& task : list_recordings(options_.batch))
      if (!take(task)) return exit_signal + signal_received();
    return failed_ ? exit_user_error : empty_ ? exit_numerical : exit_converged;
  }

 private:
  // False if the user wants to stop.
  bool take(const RecordingTask& task) {
    RecordingProgress progress(task.recording, options_.batch.quiet);
    Containment limits;
    limits.patience_s = options_.measuring.patience_s;
    // The summary is one line and goes ahead of the file's text.
    const auto work = [&](const TellProgress& tell_progress) {
      const auto result = moduli_of_recording(task.recording, options_, between_, simulated_, tell_progress);
      return to_json(result.summary) + "\n" + result.text;
    };
    const ContainedEnd end = run_contained(work, limits, [&](double fraction) { progress(fraction); });
    if (end.kind == ContainedEnd::Kind::stopped) return false;
    if (end.kind != ContainedEnd::Kind::finished) {
      failed_ = true;
      tell(sentence_for(task.recording, end, limits.patience_s));
      return true;
    }
    const auto line_end = end.text.find('\n');
    const fs::path file = task.output.events.parent_path() / (task.recording.stem().string() + "_moduli.tsv");
    write_own_file(file, std::string_view(end.text).substr(line_end + 1), mark, Foreign::keep);
    say(task, file, moduli_summary_from_json(end.text.substr(0, line_end)));
    return true;
  }

  void say(const RecordingTask& task, const fs::path& file, const ModuliSummary& summary) {
    const std::string name = one_line(task.recording.string(), 200);
    if (!options_.batch.quiet) {
      fmt::print("{}: {}, see {}\n", name, in_one_line(summary), file.string());
      for (const auto& warning : summary.warnings) tell(fmt::format("{}: {}", name, warning));
    }
    if (summary.with_stiffness() > 0) return;
    empty_ = true;
    tell(fmt::format("{}: no event {}has the shape of a cell of the table {}: {}.", name,
                     summary.gates.empty() ? "" : "inside the gates ", table_.spec.identifier, in_one_line(summary)));
  }

  const ModuliOptions& options_;
  CombinedTable table_;
  CombinedInterpolation between_;
  FlowConditions simulated_;
  bool failed_ = false, empty_ = false;
};

}  // namespace

void add_moduli_command(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("moduli", "bulk and cortex moduli of the cells in recordings (.rtdc) from their contours");
  auto options = std::make_shared<ModuliOptions>();
  declare_batch_options(*command, options->batch);
  command
      ->add_option("--table", options->table,
                   "folder of a combined table of `rheocyte table` (examples/tables/combined.toml)")
      ->required()
      ->type_name("DIR");
  declare_measuring_options(*command, options->measuring);
  command->add_flag("--fit-tension", options->fit_tension, "the tension, too, by a table with several of them");
  command->add_flag("--only-figure", options->only_figure,
                    "by area, deformation and Lambda1/Lambda2, the measures of the paper's figure 9");
  command->callback([options, &exit_code] {
    check_measuring_options(options->measuring);
    watch_signals();
    exit_code = Batch(*options).run();
  });
}

}  // namespace rheocyte
