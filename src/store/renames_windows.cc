#include <windows.h>

#include <cerrno>
#include <system_error>

#include "store/renames.h"
#include "store/scratch.h"
#include "store/windows_errors.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

int move_file(const fs::path& from, const fs::path& to, DWORD flags) {
  return patiently([&] { return ::MoveFileExW(from.c_str(), to.c_str(), flags) ? 0 : last_error(); });
}

}  // namespace

int rename_to_new(const fs::path& from, const fs::path& to) { return move_file(from, to, MOVEFILE_WRITE_THROUGH); }

int rename_over(const fs::path& from, const fs::path& to) {
  return move_file(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH);
}

/// Windows knows no exchange: for a moment nothing stands under the second name.
int exchange_names(const fs::path& one, const fs::path& other) {
  const fs::path aside = scratch_beside(place_of(other));
  if (const int failed = rename_to_new(other, aside)) return failed;
  if (const int failed = rename_to_new(one, other)) {
    rename_to_new(aside, other);
    return failed;
  }
  return rename_to_new(aside, one);
}

}  // namespace rheocyte
