#include "app/solve_case.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/exit_codes.h"
#include "app/picture.h"
#include "app/result.h"
#include "app/result_folder.h"
#include "app/standard_error.h"
#include "app/stop_signal.h"
#include "case/read_case.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "case/write_case.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

// One plain line per continuation step, so that logs stay readable.
ProgressCallback progress_lines(const Case& c) {
  return [cell = c.cell, step = 0](const BranchStep& point) mutable {
    const double share = 1 / point.compliance;
    const auto stiffness = point.compliance <= 0 ? "rigid"
                           : cell.bulk.young_modulus_kPa
                               ? fmt::format("E = {:.5g} kPa", share * *cell.bulk.young_modulus_kPa)
                               : fmt::format("E2D = {:.5g} mN/m", share * cell.cortex.modulus_mN_per_m.value_or(0));
    tell(fmt::format("step {:>3}  {:<16}  degree {:>2}  deformation {:.6f}  {} Newton iterations", ++step, stiffness,
                     point.degree, point.deformation, point.newton_iterations));
  };
}

// A stream that was not flushed may not notice a full disk: what is complete ends with the closing tag.
bool is_complete_vtu(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const auto size = stream.tellg();
  std::string end(static_cast<std::size_t>(std::min<std::streamoff>(size < 0 ? 0 : std::streamoff(size), 64)), '\0');
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  return end.find("</VTKFile>") != std::string::npos;
}

void write_fields(const Result& result, const ResultFolder& folder, const fs::path& wanted_folder) {
  if (!result.state.write_fields) return;  // stopped or failed before there was any state
  const fs::path file = folder.scratch() / "fields.vtu";
  bool written = false;
  try {
    written = result.state.write_fields(file.string(), result.scales) && is_complete_vtu(file);
  } catch (const std::exception&) {
    // deal.II throws a page about its own source when the stream fails; the user needs the sentence below.
  }
  if (!written)
    throw UserError(fmt::format("{}: cannot write fields.vtu, is the disk full? An older result is left as it was.",
                                wanted_folder.string()));
}

void write_result(const Result& result, const SolveOptions& options, const std::string& json) {
  ResultFolder folder(options.folder);
  folder.write("case.toml", to_toml(result.input));
  folder.write("contour.csv", contour_csv(result));
  write_fields(result, folder, options.folder);
  folder.write("result.json", json);
  if (!options.no_picture)
    if (const auto failure = draw_picture(folder.scratch()); !failure.empty())
      tell(fmt::format("rheocyte: warning: no picture ({}); the numbers are complete.", one_line(failure, 300)));
  folder.publish();
}

void print_result(const Result& result, const SolveOptions& options, const std::string& json) {
  const auto text = options.json ? json : options.quiet ? "" : summary(result, options.folder.string());
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw UserError("rheocyte: standard output cannot be written; the result is in the folder.");
}

int exit_code_of(const Outcome& outcome) {
  if (outcome.status == Status::stopped) return exit_signal + signal_received();
  return outcome.status == Status::converged ? exit_converged : exit_numerical;
}

}  // namespace

int solve_case(const SolveOptions& options) {
  const Case c = read_case(options.case_file, options.settings);
  if (options.check_only) return exit_converged;
  check_result_folder(options.folder);
  watch_signals();

  Result result{c, scales_of(c), problem_of(c), {}};
  const auto progress = options.quiet ? ProgressCallback{} : progress_lines(c);
  result.state = solve_stationary(result.problem, progress, &stop_wanted());
  refuse_unfinite_numbers(result.state);

  const auto json = to_json(result).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  write_result(result, options, json);
  print_result(result, options, json);
  const auto& outcome = result.state.outcome;
  if (outcome.status != Status::converged)
    tell(fmt::format("rheocyte: {}: {}", name(outcome.status), one_line(outcome.message, 800)));
  return exit_code_of(outcome);
}

}  // namespace rheocyte
