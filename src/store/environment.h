// What the shell gives the program.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace rheocyte {

/// A variable of the environment, in UTF-8; empty without it.
std::string environment(const char* variable);

/// The folders that a variable such as PATH lists.
std::vector<std::filesystem::path> folders_in(const char* variable);

/// The program that a shell would start under this name; empty if there is none.
std::filesystem::path program_in_path(const std::string& name);

/// Between the folders of such a list.
extern const char list_separator;

/// What a shell calls the interpreter of Python 3, and the prefix below which such a program and its packages lie.
extern const char* const python_name;
std::filesystem::path prefix_of_program(const std::filesystem::path& program);

}  // namespace rheocyte
