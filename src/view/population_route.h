// The part of the interface about populations: POST /api/population, and the work behind it.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "serve/router.h"
#include "store/progress.h"
#include "store/work_host.h"

namespace rheocyte {

class ViewItems;

/// Takes {"conditions": [{"name", "items": [numbers in the order of the sessions]}], "settings": {...}}, the settings
/// of `rheocyte population` but for table and jobs; those of the moduli that it does not have are left out. Answers
/// {"record": population.json, "lines": [what the command says], "command": for a shell}. The items must outlive the
/// router.
void add_population_route(Router&, ViewItems&);

/// What the process does that reads the recordings: {"conditions": [{"name", "recordings": [paths]}], "settings"}.
void compute_population(const nlohmann::ordered_json& request, const WorkReply& reply, const TellProgress& tell);

}  // namespace rheocyte
