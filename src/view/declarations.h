// What a page needs to know before anything is computed: GET /api/health, /api/keys,
// /api/settings, /api/features and /api/media.
#pragma once
#include "serve/router.h"

namespace rheocyte {

void add_declaration_routes(Router&);

}  // namespace rheocyte
