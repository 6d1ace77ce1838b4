// What a case in a duct may ask for.
#pragma once
#include "case/case.h"
#include "case/key_reading.h"

namespace rheocyte {

/// UserErrors for what is computed in tubes alone, at rest or in time.
void check_duct(const Case&, const KeyReading&);

/// UserErrors for sizes that do not make a rectangle; its profile must be right.
void check_rectangle(const Case&, const KeyReading&);

}  // namespace rheocyte
