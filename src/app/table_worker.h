// One process of many that compute a table: takes one branch after the other that nobody else works on.
#pragma once
#include <filesystem>

namespace rheocyte {

/// UserError if this program cannot take part in the table, because it is of another build than the one that began it.
void check_table(const std::filesystem::path& folder);

/// Computes what is missing in a table's folder. Exit code; a signal ends it within one Newton iteration, and nothing
/// that is finished is lost.
int work_on_table(const std::filesystem::path& folder);

}  // namespace rheocyte
