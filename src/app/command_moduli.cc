#include "app/command_moduli.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>

#include "app/contained_sentence.h"
#include "app/exit_codes.h"
#include "app/moduli_recording.h"
#include "app/own_file.h"
#include "app/recording_list.h"
#include "app/standard_error.h"
#include "app/stop_signal.h"
#include "case/user_error.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "# rheocyte ";

/// How many events have each status, from the ends of the lines.
std::string counts(const std::string& text) {
  std::string said;
  for (const auto status : {ModuliStatus::resolved, ModuliStatus::not_told_apart, ModuliStatus::outside_table,
                            ModuliStatus::poor_fit, ModuliStatus::no_data}) {
    const std::string end = fmt::format("\t{}\n", name_of(status));
    int count = 0;
    for (auto at = text.find(end); at != std::string::npos; at = text.find(end, at + 1)) ++count;
    said += fmt::format("{}{} {}", said.empty() ? "" : ", ", count, name_of(status));
  }
  return said;
}

int work(const ModuliOptions& options) {
  const CombinedTable table = read_combined_table(options.measuring.table);
  const CombinedInterpolation between(table);
  const FlowConditions simulated = conditions_of(table.spec);
  if (options.fit_tension && between.tension_ratios().size() < 2)
    throw UserError(
        fmt::format("rheocyte: --fit-tension needs a table with several tensions (table.tension_ratio); {} "
                    "has one.",
                    table.spec.identifier));
  bool failed = false;
  for (const auto& task : list_recordings(options.measuring)) {
    Containment limits;
    limits.patience_s = options.measuring.patience_s;
    const ContainedEnd end = run_contained(
        [&](const TellProgress& tell_progress) {
          return moduli_text(task.recording, options, between, simulated, tell_progress);
        },
        limits, [](double) {});
    if (end.kind == ContainedEnd::Kind::stopped) return exit_signal + signal_received();
    if (end.kind != ContainedEnd::Kind::finished) {
      failed = true;
      tell(sentence_for(task.recording, end, limits.patience_s));
      continue;
    }
    const fs::path result = task.output.events.parent_path() / (task.recording.stem().string() + "_moduli.tsv");
    write_own_file(result, end.text, mark, false);
    if (!options.measuring.quiet) fmt::print("{}: {}\n", result.string(), counts(end.text));
  }
  return failed ? exit_user_error : exit_converged;
}

}  // namespace

void add_moduli_command(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("moduli", "bulk and cortex moduli of the cells in recordings (.rtdc) from their contours");
  auto options = std::make_shared<ModuliOptions>();
  command->add_option("FILES", options->measuring.inputs, "recordings (.rtdc); folders with -r")->required();
  command
      ->add_option("-o,--output", options->measuring.folder, "folder for the results; default: beside each recording")
      ->type_name("DIR");
  command->add_flag("-r,--recursive", options->measuring.recursive, "search the given folders for recordings");
  command
      ->add_option("--table", options->measuring.table,
                   "folder of a combined table of `rheocyte table` (examples/tables/combined.toml)")
      ->required()
      ->type_name("DIR");
  declare_measuring_options(*command, options->measuring);
  command->add_flag("--fit-tension", options->fit_tension, "the tension, too, by a table with several of them");
  command->add_flag("--only-figure", options->only_figure,
                    "by area, deformation and Lambda1/Lambda2, the measures of the paper's figure 9");
  command->add_flag("--quiet", options->measuring.quiet, "print no results");
  command->callback([options, &exit_code] {
    check_measuring_options(options->measuring);
    watch_signals();
    exit_code = work(*options);
  });
}

}  // namespace rheocyte
