// Empty texts on the command line: mostly a variable of a script that was never set.
#pragma once
#include <span>

namespace CLI {
class App;
}

namespace rheocyte {

/// UserError if an argument, the value of an option of the chosen command, or an entry of a list is empty or blank: the
/// parser would take such a text for the number 0, or leave it out. `arguments` are those behind the program's name.
void refuse_empty_arguments(const CLI::App& app, std::span<char* const> arguments);

}  // namespace rheocyte
