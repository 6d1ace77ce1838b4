#include "app/finish_result.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/exit_codes.h"
#include "case/json_guard.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "store/standard_error.h"
#include "store/standard_output.h"
#include "store/stop_signal.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

// A stream that was not flushed may not notice a full disk: what is complete ends with the closing tag.
bool is_complete_vtu(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const auto size = stream.tellg();
  std::string end(static_cast<std::size_t>(std::min<std::streamoff>(size < 0 ? 0 : std::streamoff(size), 64)), '\0');
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  return end.find("</VTKFile>") != std::string::npos;
}

void write_result(const Result& result, ResultFolder& folder, const SolveOptions& options, const std::string& json,
                  std::optional<Drawing>& drawing) {
  folder.write("case.toml", to_toml(result.input));
  folder.write("contour.csv", contour_csv(result.state.surface, result.scales));
  if (result.problem.section == Section::square) {
    folder.write("contour_side.csv", contour_csv(result.state.views[0], result.scales));
    folder.write("contour_diagonal.csv", contour_csv(result.state.views[1], result.scales));
  }
  if (result.state.write_fields)  // else stopped or failed before there was any state
    write_field_file(result.state.write_fields, result.scales, folder.scratch() / "fields.vtu", options.folder);
  folder.write("result.json", json);
  if (drawing)
    if (const auto failure = drawing->finish(folder.scratch()); !failure.empty())
      tell(fmt::format("rheocyte: warning: no picture ({}); the numbers are complete.", one_line(failure, 300)));
  folder.publish();
}

void print_result(const Result& result, const SolveOptions& options, const std::string& json) {
  print(options.json ? json : options.quiet ? "" : summary(result, options.folder.string()));
}

int exit_code_of(const Outcome& outcome) {
  if (outcome.status == Status::stopped) return exit_stopped();
  return outcome.status == Status::converged ? exit_converged : exit_numerical;
}

}  // namespace

void write_field_file(const FieldWriter& write, const Scales& scales, const fs::path& file,
                      const fs::path& wanted_folder) {
  bool written = false;
  try {
    written = write(file.string(), scales) && is_complete_vtu(file);
  } catch (const std::exception&) {
    // Whatever it says of itself, the user needs the sentence below.
  }
  if (!written)
    throw UserError(fmt::format("{}: cannot write {}, is the disk full? An older result is left as it was.",
                                wanted_folder.string(), file.filename().string()));
}

int finish_result(const Result& result, ResultFolder& folder, const SolveOptions& options,
                  const nlohmann::ordered_json& numbers, std::optional<Drawing>& drawing) {
  const auto json = json_text(numbers) + "\n";
  write_result(result, folder, options, json, drawing);
  print_result(result, options, json);
  const auto& outcome = result.state.outcome;
  if (outcome.status != Status::converged)
    tell(fmt::format("rheocyte: {}: {}", name(outcome.status), one_line(outcome.message, 800)));
  return exit_code_of(outcome);
}

}  // namespace rheocyte
