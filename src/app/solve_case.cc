#include "app/solve_case.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "app/exit_codes.h"
#include "app/finish_result.h"
#include "app/solve_in_time.h"
#include "case/case_line.h"
#include "case/json_guard.h"
#include "case/read_case.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "result/gradient.h"
#include "result/plural.h"
#include "store/build_info.h"
#include "store/result_folder.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"
#include "sweep/shared_work.h"

namespace rheocyte {

namespace {

// One plain line per continuation step, so that logs stay readable.
ProgressCallback progress_lines(const Case& c) {
  return [cell = c.cell, step = 0](const BranchStep& point) mutable {
    const double fraction = 1 / point.compliance;
    const auto stiffness = point.compliance <= 0 ? "rigid"
                           : cell.bulk.young_modulus_kPa
                               ? fmt::format("E = {:.5g} kPa", fraction * *cell.bulk.young_modulus_kPa)
                               : fmt::format("E2D = {:.5g} mN/m", fraction * cell.cortex.modulus_mN_per_m.value_or(0));
    tell(fmt::format("step {:>3}  {:<16}  degree {:>2}  deformation {:.6f}  {}", ++step, stiffness, point.degree,
                     point.deformation, plural(point.newton_iterations, "Newton iteration")));
  };
}

// What a result of this case will say about it, so that a script can see whether it has that result already.
void print_case(const Case& c) {
  nlohmann::ordered_json json{{"program", "rheocyte"}, {"version", version}};
  json["case"] = to_json(c);
  json["case_hash"] = case_hash(c);
  print(json_text(json) + "\n");
}

}  // namespace

WorkLimits work_limits(const SolveOptions& options) {
  return {&stop_wanted(), options.threads > 0 ? options.threads : available_processors()};
}

int solve_case(const SolveOptions& options) {
  const Case c = read_case(options.case_file, options.settings);
  const auto gradients = asked_line_keys(c, options.gradients, options.case_file.string());
  if (options.check_only) {
    if (options.json) print_case(c);
    return exit_converged;
  }
  const bool is_written = !options.folder.empty();
  if (!is_written && c.time.scheme != TimeScheme::stationary)
    throw UserError("rheocyte: a case with a [time] section needs a folder for its results; give one with -o.");
  if (is_written) check_result_folder(options.folder);
  watch_signals();
  std::optional<Drawing> drawing;  // loads while the solver runs
  if (is_written && !options.no_picture) drawing.emplace("picture");
  if (c.time.scheme != TimeScheme::stationary) return solve_in_time(c, options, drawing);
  if (!options.start_from.empty())
    throw UserError("rheocyte: --start is for a case with a [time] section; a stationary case needs no start.");
  if (!options.continue_from.empty())
    throw UserError(
        "rheocyte: --continue is for a case with a [time] section; a stationary case has nothing to continue.");

  const auto progress = options.quiet ? ProgressCallback{} : progress_lines(c);
  const Result result = solve_with_gradients(c, gradients, [&](const Problem& problem, std::span<ProblemLine> lines) {
    return solve_stationary(problem, progress, work_limits(options), lines);
  });

  if (const std::string missing = missing_gradients(result); !missing.empty()) tell("rheocyte: " + missing);
  if (!is_written) return report_result(result, options, to_json(result));
  ResultFolder folder(options.folder);
  return finish_result(result, folder, options, to_json(result), drawing);
}

}  // namespace rheocyte
