// `rheocyte population [SPEC.toml]`: the mechanics of the cells of recordings, and whether conditions differ.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/extract_options.h"
#include "app/population_folder.h"
#include "app/population_spec.h"
#include "app/recording_batch.h"
#include "case/user_error.h"
#include "events/recording_settings.h"
#include "experiment/analyse_populations.h"
#include "report/population_lines.h"
#include "report/settings_text.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

void tell_recording(const RecordingReport& r) {
  const std::string name = one_line(r.recording.string(), 200);
  for (const auto& warning : r.warnings) tell(fmt::format("{}: {}", name, warning));
  if (!r.failure.empty()) tell(fmt::format("{}: {}", name, r.failure));
}

/// What the command is asked beside its settings.
struct PopulationCall {
  PopulationOptions options;
  fs::path spec;
  bool no_picture = false;
};

/// Of the specification, if there is one, with what else is said on the command line.
PopulationSpec asked_for(const PopulationCall& call) {
  if (call.spec.empty()) return {call.options, conditions_of(call.options)};
  if (!call.options.conditions.empty())
    throw UserError("rheocyte: --condition and SPEC.toml contradict each other; give the conditions in one place.");
  PopulationSpec spec = read_population_spec(call.spec);
  PopulationOptions given = call.options;
  take_settings(settings_of(spec.options), given_settings(settings_of(given)));
  spec.options.folder = given.folder;
  spec.options.quiet = given.quiet;
  check_conditions(spec.conditions, spec.options.paired);
  return spec;
}

int run(const PopulationCall& call) {
  const auto [options, conditions] = asked_for(call);
  check_options(options.measuring);
  for (const auto& condition : conditions)
    for (const auto& recording : condition.recordings) check_is_there(recording);
  const ResultFolderGuard place(options.folder, {});
  PopulationFolder results(options, conditions, !call.no_picture);
  const PopulationReport report = analyse(conditions, options, until_signal(FileProgress("population", options.quiet)));
  for (const RecordingReport& recording : report.recordings) tell_recording(recording);
  results.write(report);
  for (const auto& warning : report.warnings) tell(warning);
  if (!options.quiet) {
    for (const std::string& line : population_lines(report)) print(line + "\n");
    print(fmt::format("see {}\n", (options.folder / "population.json").string()));
  }
  return report.has_failures() ? exit_numerical : exit_converged;
}

}  // namespace

void add_population_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "population",
      "Young's modulus of populations of cells in recordings (.rtdc), and differences between conditions");
  command->footer("For example: rheocyte population --condition control=A.rtdc,B.rtdc --condition drug=C.rtdc,D.rtdc");
  auto call = std::make_shared<PopulationCall>();
  PopulationOptions* const options = &call->options;
  options->folder = "population";
  command
      ->add_option("SPEC", call->spec,
                   "file with the conditions and any of these options: a section [conditions] with NAME = [FILE, ...], "
                   "paths relative to this file, and options by their names without -- and with _ for -")
      ->type_name("SPEC.toml");
  command
      ->add_option("--condition", options->conditions,
                   "a condition and its recordings; the first condition is the control")
      ->type_name("NAME=FILE,FILE,...");
  command->add_option("-o,--output", options->folder, "folder for the results; default: population")->type_name("DIR");
  command->add_flag("--quiet", options->quiet, "print neither progress nor results");
  command->add_flag("--no-picture", call->no_picture, "no pictures");
  declare_settings(*command, settings_of(*options));
  command->callback([call, &exit_code] {
    watch_signals(SecondSignal::waits);
    exit_code = run(*call);
  });
}

}  // namespace rheocyte
