// `rheocyte solve` on the engine's side.
#pragma once
#include "app/solve_options.h"

namespace rheocyte {

/// Reads, solves, writes the folder, prints. Returns the exit code (exit_codes.h); UserError for the case and the disk.
int solve_case(const SolveOptions&);

}  // namespace rheocyte
