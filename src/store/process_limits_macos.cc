// Compiled, not run (tools/macos).
#include "store/process_limits.h"
#include "store/process_limits_of_system.h"

namespace rheocyte {

const char* const whose_memory = "this machine";

void take_stack() {}

int allowed_processors() { return 0; }

void keep_freed_memory() {}

}  // namespace rheocyte
