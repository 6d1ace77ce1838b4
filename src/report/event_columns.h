// What `rheocyte extract` reports of each event. A new column needs its values in EventBlock and its declaration here.
#pragma once
#include <vector>

#include "extract/event_block.h"
#include "report/event_column.h"

namespace rheocyte {

/// In the order of tables.
ColumnsOf<EventBlock> event_columns(const EventKnowledge&);

/// All that can have a role in a companion, those of the least rank first.
std::vector<ColumnDescription> companion_columns();

}  // namespace rheocyte
