// `rheocyte solve` of a case with a [time] section.
#pragma once
#include <optional>

#include "app/solve_case.h"
#include "case/case.h"
#include "store/python_package.h"

namespace rheocyte {

/// Follows the cell, writes the folder, prints. Returns the exit code; UserError for checkpoints and the disk. Signals
/// are watched already.
int solve_in_time(const Case&, const SolveOptions&, std::optional<Drawing>& drawing);

}  // namespace rheocyte
