// What the processes do that read items for the view: one request each, JSON in, JSON or bytes out.
#pragma once
#include <string>
#include <vector>

#include "view/view_part.h"

namespace rheocyte {

/// That of the part with the routes of recordings.
std::vector<ItemWork> work_on_items();

/// Of any part: a request names what is to be done in "do", the item in "file" and "kind", and what else the work
/// needs; see the file. UserError.
void do_item_work(const std::string& request, const WorkReply& reply);

}  // namespace rheocyte
