// The part of the interface about recordings: /api/items and what is below, and their exports.
#pragma once
#include "serve/router.h"
#include "view/export_folder.h"
#include "view/view_session.h"

namespace rheocyte {

class ViewItems;

/// The items must outlive the router.
void add_recording_routes(Router&, Exports&, ViewSession&, ViewItems&);

}  // namespace rheocyte
