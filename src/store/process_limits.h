// What the system allows this process.
#pragma once
#include <cstddef>
#include <string>

namespace rheocyte {

/// Lifts a small limit of the stack as far as it may be lifted and starts the program again, since threads keep the
/// limit of the start; takes the memory of a stack that suffices (without it, the end is that of end_without_memory).
/// Returns nothing if the stack suffices, else a sentence.
std::string secure_stack(char** arguments);

/// The processors that this process may use; 0 if the system does not say.
int allowed_processors();

/// Files and connections that this process may have open at once.
std::size_t open_files_limit();

/// Lets freed memory stay with the program: where matrices come and go by the hundred in each iteration, giving it back
/// each time costs more than they do.
void keep_freed_memory();

/// From now on a lack of memory ends the process at once with one sentence and this exit code; Eigen's matrices do not
/// survive std::bad_alloc, since they give up the old memory before they have the new.
void end_without_memory(int exit_code);

}  // namespace rheocyte
