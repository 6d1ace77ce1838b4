// POST /api/evolve: a cell on its way in time, line by line.
#pragma once
#include "serve/router.h"

namespace rheocyte {

void add_evolve_route(Router&);

}  // namespace rheocyte
