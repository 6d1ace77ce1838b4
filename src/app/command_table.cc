// `rheocyte table`: a whole look-up table from a spec, stationary or dynamic.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "app/cli.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "case/case_text.h"
#include "case/user_error.h"
#include "shelf/tube_table.h"
#include "store/build_info.h"
#include "store/progress.h"
#include "store/python_package.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"
#include "sweep/dynamic_folder.h"
#include "sweep/table_work.h"
#include "table/finish_table.h"

namespace rheocyte {

namespace {

struct TableOptions {
  std::filesystem::path spec, folder;
  std::vector<std::string> settings;
  std::vector<double> levels;  ///< of the lines; empty: chosen by the table
  int jobs = 0;
  bool quiet = false, no_picture = false;
};

void draw(const TableFolder& folder) {
  if (const auto failure = Drawing("table_picture").finish(folder.path()); !failure.empty())
    tell(fmt::format("rheocyte: warning: no pictures ({}); the tables are complete.", one_line(failure, 300)));
}

/// What the process takes part with: rank 0 finishes the table.
struct OwnWork {
  explicit OwnWork(const TableOptions& options)
      : jobs(options.jobs > 0 ? options.jobs : available_processors(rank)), quiet(options.quiet || rank.number > 0) {}
  Rank rank = rank_from_environment();
  int jobs;
  bool quiet;
};

/// False if a signal has ended it.
bool compute(const SharedWork& work, const char* pieces, const OwnWork& own) {
  Progress progress(pieces, work.pieces(), work.done(), own.quiet);
  const WorkObserver observer{[&](int done) { progress.show(done); },
                              [&] {
                                if (!own.quiet) tell("the rest is being computed by other processes");
                              }};
  const bool is_complete = work_on(work, own.jobs, observer, stop_wanted());
  progress.finish();
  if (!is_complete)
    tell(fmt::format("rheocyte: stopped after {} of {} {}; the same command continues from here.", work.done(),
                     work.pieces(), pieces));
  return is_complete;
}

std::string failure_text(const std::vector<CellCourse>& failed) {
  const CellCourse& first = failed.front();
  return fmt::format(
      "rheocyte: {} of the cells cannot be followed to the last place, for example {:.4g} um, {:.4g} kPa, {:.4g} mPa "
      "s: "
      "{} Raise dynamic.min_young_modulus_kPa or lower dynamic.max_radius_um, in a new folder.",
      failed.size(), first.cell.radius_um, first.cell.young_modulus_kPa, first.cell.viscosity_mPas(), first.message);
}

int make_dynamic_table(const TableOptions& options, const std::string& text) {
  const DynamicSpec spec = parse_dynamic_spec(text, options.spec.string(), options.settings);
  watch_signals();
  const OwnWork own(options);
  const DynamicFolder folder(options.folder, spec);
  if (!compute(folder, "cells", own)) return exit_stopped();
  if (own.rank.number > 0) return exit_converged;
  auto courses = folder.courses();
  if (const auto ended_early = failed(courses); !ended_early.empty())
    return tell(failure_text(ended_early)), exit_numerical;
  const double seconds = std::accumulate(courses.begin(), courses.end(), 0.0,
                                         [](double sum, const CellCourse& course) { return sum + course.seconds; });
  const DynamicTable table = folder.finish(std::move(courses));
  const CourseErrors& errors = table.errors();
  if (!options.quiet)
    print(
        fmt::format("dynamic table {}: {} cells at {} places in {:.0f} s of computation; at {} cells between them c3 "
                    "is off by at most {:.2f} %, the deformation by {:.2f} % of its maximum  folder {}\n",
                    spec.identifier, nodes(spec), spec.places, seconds, errors.cells, 100 * errors.mode_3,
                    100 * errors.deformation, options.folder.string()));
  return exit_converged;
}

int make_table(const TableOptions& options) {
  if (const std::string text = read_case_text(options.spec, specification("table"));
      is_dynamic_spec(text, options.spec.string(), options.settings))
    return make_dynamic_table(options, text);
  const TableSpec spec = read_table_spec(options.spec, options.settings);
  const TableFolder folder(options.folder, spec);
  const OwnWork own(options);
  watch_signals();
  provide_tube_table(folder);
  folder.take_over();
  if (!compute(TableWork(folder), "branches", own)) return exit_stopped();
  if (own.rank.number > 0) return exit_converged;
  for (const auto& sentence : finish_table(folder, options.levels, version)) tell("rheocyte: warning: " + sentence);
  if (!options.no_picture && !spec.is_combined() && !spec.is_elongated()) draw(folder);
  if (!options.quiet) print(fmt::format("{}  folder {}\n", summary(folder), options.folder.string()));
  return exit_converged;
}

}  // namespace

void add_table_command(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("table", "compute a look-up table; an interrupted computation is continued");
  command->footer("For example: rheocyte table examples/tables/first-table.toml -o first-table");
  auto options = std::make_shared<TableOptions>();
  command
      ->add_option("SPEC", options->spec,
                   "spec of the table, a TOML file (see `rheocyte help table`, `help dynamic` and examples/tables)")
      ->required();
  command->add_option("-o,--output", options->folder, "folder of the table")->required();
  command->add_option("--set", options->settings, "replace a key of the spec; may be repeated")
      ->type_name("key=value")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--levels", options->levels,
          "stiffnesses of the isoelasticity lines (kPa; of shells mN/m), comma-separated; default: 11 within the table")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  command->add_flag("--no-picture", options->no_picture, "no pictures");
  command
      ->add_option("-j,--jobs", options->jobs,
                   "number of threads; default: all processors, or those assigned to an MPI rank")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--quiet", options->quiet, "print neither progress nor summary");
  command->callback([options, &exit_code] { exit_code = make_table(*options); });
}

}  // namespace rheocyte
