// Look-up tables by file or by name.
#pragma once
#include <filesystem>
#include <string>

namespace rheocyte {

/// A file or folder of this name, the table of this identifier that comes with the program, or that of an installed
/// dclab (its folder features/emodulus below the site-packages of a virtual environment, of the python3 of the PATH, of
/// the user or of the system).
/// UserError naming those that were found, and the option or key that asks for it.
/// `folder`: of the tables that come with the program (shipped_tables.h).
std::filesystem::path find_table(const std::string& wanted, const std::string& asked_by = "--table",
                                 const std::filesystem::path& folder = {});

}  // namespace rheocyte
