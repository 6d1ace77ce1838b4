// A folder for what a program keeps on disk while it runs.
#pragma once
#include "store/scratch.h"

namespace rheocyte {

/// Makes it in the folder for temporary files, within one that this program claims: one that puts files in their places
/// claims their folder and would wait. Also removes those that killed programs have left. UserError.
Scratch new_private_folder();

}  // namespace rheocyte
