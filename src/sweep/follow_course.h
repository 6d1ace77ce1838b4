// The way of one cell of a dynamic table.
#pragma once
#include <atomic>

#include "table/dynamic_table.h"

namespace rheocyte {

/// Follows one cell; never throws for a numerical failure. No course has its end whose surface is beyond the limit
/// against short wrinkles at one of the table's places.
CellCourse follow_course(const DynamicSpec&, const DynamicCell&, const std::atomic<bool>* stop = nullptr);

}  // namespace rheocyte
