#include "app/finish_result.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/exit_codes.h"
#include "case/json_guard.h"
#include "case/user_error.h"
#include "result/write_result.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace {

void finish_folder(const Result& result, ResultFolder& folder, const SolveOptions& options, const std::string& json,
                   std::optional<Drawing>& drawing) {
  write_result(result, folder, options.folder, json);
  if (drawing)
    if (const auto failure = drawing->finish(folder.scratch()); !failure.empty())
      tell(fmt::format("rheocyte: warning: no picture ({}); the numbers are complete.", one_line(failure, 300)));
  folder.publish();
}

void print_result(const Result& result, const SolveOptions& options, const std::string& json) {
  print(options.json ? json : options.quiet ? "" : summary(result, options.folder.string()));
}

int exit_code_of(const Outcome& outcome) {
  if (outcome.status == Status::stopped || stop_wanted()) return exit_stopped();
  return outcome.status == Status::converged ? exit_converged : exit_numerical;
}

}  // namespace

int finish_result(const Result& result, ResultFolder& folder, const SolveOptions& options,
                  const nlohmann::ordered_json& numbers, std::optional<Drawing>& drawing) {
  finish_folder(result, folder, options, json_text(numbers) + "\n", drawing);
  return report_result(result, options, numbers);
}

int report_result(const Result& result, const SolveOptions& options, const nlohmann::ordered_json& numbers) {
  print_result(result, options, json_text(numbers) + "\n");
  const auto& outcome = result.state.outcome;
  if (outcome.status != Status::stopped && stop_wanted())
    tell("rheocyte: interrupted by a signal: error estimates or pictures may be missing.");
  if (outcome.status != Status::converged)
    tell(fmt::format("rheocyte: {}: {}", name(outcome.status), one_line(outcome.message, 800)));
  return exit_code_of(outcome);
}

}  // namespace rheocyte
