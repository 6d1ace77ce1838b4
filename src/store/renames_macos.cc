// Compiled, not run (tools/macos).
#include <cerrno>
#include <cstdio>

#include "store/renames.h"

namespace rheocyte {

namespace {

/// 0, or the number of the error, as store/renames.h has it.
int renamed(const std::filesystem::path& from, const std::filesystem::path& to, unsigned how) {
  if (::renamex_np(from.c_str(), to.c_str(), how) == 0) return 0;
  return errno == ENOTSUP ? EINVAL : errno;
}

}  // namespace

int rename_to_new(const std::filesystem::path& from, const std::filesystem::path& to) {
  return renamed(from, to, RENAME_EXCL);
}

int exchange_names(const std::filesystem::path& one, const std::filesystem::path& other) {
  return renamed(one, other, RENAME_SWAP);
}

int rename_over(const std::filesystem::path& from, const std::filesystem::path& to) { return renamed(from, to, 0); }

}  // namespace rheocyte
