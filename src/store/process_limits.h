// What the system allows this process.
#pragma once
#include <string>

namespace rheocyte {

/// Lifts a small limit of the stack as far as it may be lifted and starts the program anew, since threads keep the
/// limit of the start. Returns nothing if the stack suffices, else a sentence.
std::string lift_stack_limit(char** arguments);

/// From now on a lack of memory ends the process at once with one sentence and this exit code; Eigen's matrices do not
/// survive std::bad_alloc, since they give up the old memory before they have the new.
void end_without_memory(int exit_code);

}  // namespace rheocyte
