// The last part of `rheocyte solve`: from a state to the folder, the picture, the printed lines and the exit code.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/solve_case.h"
#include "result/result.h"
#include "store/python_package.h"
#include "store/result_folder.h"

namespace rheocyte {

/// Completes and publishes the folder, prints, and returns the exit code. `numbers` is the content of result.json;
/// without a drawing there is no picture.
int finish_result(const Result&, ResultFolder& folder, const SolveOptions&, const nlohmann::ordered_json& numbers,
                  std::optional<Drawing>& drawing);

/// Prints and returns the exit code, without a folder.
int report_result(const Result&, const SolveOptions&, const nlohmann::ordered_json& numbers);

}  // namespace rheocyte
