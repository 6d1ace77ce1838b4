// In which direction the cells of a recording move.
#pragma once
#include <string_view>

#include "measurement/event_outlines.h"

namespace rheocyte {

/// +1 or -1 along x, from the sign of the mean asymmetry (mode c_3) of some thousand outlines; 0 if chance decides.
/// `sign`: of c_3 of cells that move towards +x. UserError if the data are damaged.
int direction_of_cells(EventOutlines& outlines, double sign);
/// What it returns, in words.
std::string_view direction_text(int direction);

}  // namespace rheocyte
