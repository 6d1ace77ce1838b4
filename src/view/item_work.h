// What the processes do that read items for the view: one request each, JSON in, JSON or bytes out.
#pragma once
#include <string>

#include "store/work_host.h"

namespace rheocyte {

/// A request names what is to be done in "do", the item in "file" and "kind", and what else the work needs; see the
/// file. UserError.
void do_item_work(const std::string& request, const WorkReply& reply);

}  // namespace rheocyte
