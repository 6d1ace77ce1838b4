// One process of many that compute a table: takes one branch after the other that nobody else works on.
#pragma once
#include <filesystem>

namespace rheocyte {

/// Computes what is missing in a table's folder. Exit code; a signal ends it within one Newton iteration, and nothing
/// that is finished is lost.
int work_on_table(const std::filesystem::path& folder);

}  // namespace rheocyte
