// Which of the program's other tables has cells that look like those of a recording.
#pragma once
#include "extract/shape_tally.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {

/// Of the tables for other laws or another section of the channel the one whose inertia ratios the events have, by
/// their median; if several have, the nearest. Without a name if none has. UserError if a table cannot be read.
FittingTable fitting_table(const ModulusTables& tables, const MeasuringConditions& conditions,
                           const JudgedShapes& events);

}  // namespace rheocyte
