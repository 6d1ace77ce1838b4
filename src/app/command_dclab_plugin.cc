// `rheocyte dclab-plugin`
// Prints a program text of the Python package and, behind it, the tables.

#include <cstddef>
#include <cstdio>
#include <string>

#include "app/cli.h"
#include "app/commands.h"
#include "case/refuse_path.h"
#include "case/user_error.h"
#include "report/dclab_plugin.h"
#include "store/python_package.h"
#include "store/read_file.h"

namespace rheocyte {

namespace {

constexpr std::size_t largest_program_text = 1 << 20;

void print_plugin() {
  const auto path = python_package_folder() / "rheocyte" / "modulus_plugin.py";
  std::string text = content_of_file(path, largest_program_text);
  if (text.empty()) refuse_path(path, "is empty; it is part of the program: install rheocyte again.");
  text += data_of_dclab_plugin();
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw UserError("rheocyte: standard output cannot be written.");
}

}  // namespace

void add_dclab_plugin_command(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "dclab-plugin",
      "print the self-contained plugin file with which dclab and DCscope compute the moduli of rheocyte");
  command->footer("For example: rheocyte dclab-plugin > rheocyte_modulus.py (see docs/python.md)");
  command->callback(print_plugin);
}

}  // namespace rheocyte
