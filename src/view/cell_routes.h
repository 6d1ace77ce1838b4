// The part of the interface about cells: states, ways in time, cases as text, and what is exported of them.
#pragma once
#include "serve/router.h"
#include "view/export_folder.h"
#include "view/solver_threads.h"

namespace rheocyte {

/// The threads must outlive the router.
void add_cell_routes(Router&, Exports&, SolverThreads&);

}  // namespace rheocyte
