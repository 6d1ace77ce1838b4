// The last part of `rheocyte solve`: from a state to the folder, the picture, the printed lines and the exit code.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "app/result.h"
#include "app/solve_case.h"
#include "store/python_package.h"
#include "store/result_folder.h"

namespace rheocyte {

using FieldWriter = std::function<bool(const std::string& path, const Scales&)>;

/// Writes a .vtu file and looks whether it is complete. UserError that names the folder that the user wants.
void write_field_file(const FieldWriter&, const Scales&, const std::filesystem::path& file,
                      const std::filesystem::path& wanted_folder);

/// Completes and publishes the folder, prints, and returns the exit code. `numbers` is the content of result.json;
/// without a drawing there is no picture.
int finish_result(const Result&, ResultFolder& folder, const SolveOptions&, const nlohmann::ordered_json& numbers,
                  std::optional<Drawing>& drawing);

}  // namespace rheocyte
