// `rheocyte table`: a whole look-up table from a spec.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "case/user_error.h"
#include "store/build_info.h"
#include "store/python_package.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"
#include "table/combined_table.h"
#include "table/grid_from_branches.h"
#include "table/lookup_table.h"
#include "table/simulations_file.h"
#include "table/table_folder.h"
#include "table/table_workers.h"

namespace rheocyte {

namespace {

struct TableOptions {
  std::filesystem::path spec, folder;
  std::vector<std::string> settings;
  std::vector<double> levels;  ///< of the lines; empty: chosen by the table
  int jobs = 0;
  bool quiet = false, no_picture = false;
};

void write_combined(const TableFolder& folder, const std::vector<SampledBranch>& branches) {
  folder.publish(combined_table_name(folder.spec()), combined_table_csv(make_combined_table(folder.spec(), branches)));
  folder.publish("end-of-branch.csv", combined_ends_csv(branches));
  folder.tidy();
}

void write_files(const TableFolder& folder, const TableOptions& options) {
  const auto branches = folder.read_all();
  if (folder.spec().is_combined()) return write_combined(folder, branches);
  const LookupTable table = make_lookup_table(folder.spec(), branches, version);
  for (const auto& [name, content] : table_files(table, options.levels)) folder.publish(name, content);
  folder.publish(fmt::format("simulations_{}.h5", folder.spec().identifier), simulations_file(table));
  if (const auto grid = make_stiffness_grid(folder.spec(), branches, version))
    folder.publish(grid_file_name(folder.spec().identifier), to_bytes(*grid));
  else
    tell(
        "rheocyte: warning: the branches are too few or too short for a grid; `rheocyte extract` takes the text "
        "table.");
  folder.tidy();
  if (options.no_picture) return;
  if (const auto failure = Drawing("table_picture").finish(folder.path()); !failure.empty())
    tell(fmt::format("rheocyte: warning: no pictures ({}); the tables are complete.", one_line(failure, 300)));
}

std::string summary(const TableFolder& folder) {
  int samples = 0, refused = 0, solves = 0, unstable = 0, short_of_range = 0;
  double seconds = 0, factorisation = 0;
  for (const SampledBranch& branch : folder.read_all()) {
    samples += branch.samples();
    refused += branch.refused;
    solves += branch.solves;
    seconds += branch.seconds;
    factorisation += branch.factorisation_seconds;
    if (branch.bending_kBT > 0 || branch.empty()) continue;  // those that go on where others have ended
    unstable += branch.end.status == "surface-unstable";
    short_of_range +=
        branch.end.status != "surface-unstable" && branch.end.status != "covered" && branch.end.status != "dented";
  }
  return fmt::format(
      "{} states on {} branches, {} solves, {:.0f} s of one processor ({:.0f} % factorisation)\n"
      "{} branches end at the instability of the surface, {} short of the range for other reasons (end-of-branch.csv); "
      "{} states refused\n",
      samples, folder.branches(), solves, seconds, 100 * factorisation / std::max(seconds, 1e-9), unstable,
      short_of_range, refused);
}

int make_table(const TableOptions& options) {
  const TableSpec spec = read_table_spec(options.spec, options.settings);
  const TableFolder folder(options.folder, spec);
  const Rank rank = rank_from_environment();
  const int jobs = options.jobs > 0 ? options.jobs : rank.count > 1 ? 1 : available_processors();
  if (!work_on_table(folder, jobs, options.quiet || rank.number > 0)) {
    tell(fmt::format("rheocyte: stopped after {} of {} branches; the same command goes on from here.", folder.done(),
                     folder.branches()));
    return exit_stopped();
  }
  if (rank.number > 0) return exit_converged;
  write_files(folder, options);
  if (!options.quiet) print(fmt::format("{}  folder {}\n", summary(folder), options.folder.string()));
  return exit_converged;
}

}  // namespace

void add_table_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("table", "compute a whole look-up table; goes on where it was interrupted");
  auto options = std::make_shared<TableOptions>();
  command
      ->add_option("SPEC", options->spec,
                   "spec of the table, a TOML file (see `rheocyte help table` and examples/tables)")
      ->required();
  command->add_option("-o,--output", options->folder, "folder of the table")->required();
  command->add_option("--set", options->settings, "replace a key of the spec; may be repeated")
      ->type_name("key=value")
      ->allow_extra_args(false);
  command->add_option("--levels", options->levels, "stiffnesses of the lines, comma-separated; default: 11 that fit")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  command->add_flag("--no-picture", options->no_picture, "no pictures");
  command->add_option("-j,--jobs", options->jobs, "threads; default: all processors")->check(CLI::Range(1, 1024));
  command->add_flag("--quiet", options->quiet, "no progress, no summary");
  command->callback([options, &exit_code] { exit_code = make_table(*options); });
}

}  // namespace rheocyte
