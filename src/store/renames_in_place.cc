// Of builds without processes: no one else changes the files meanwhile.
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "case/to_path.h"
#include "store/renames.h"

namespace rheocyte {

namespace fs = std::filesystem;

int rename_to_new(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(to, error))) return EEXIST;
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

int exchange_names(const fs::path& one, const fs::path& other) {
  const fs::path aside = to_path(one.string() + ".aside");
  const bool done = ::rename(other.c_str(), aside.c_str()) == 0 && ::rename(one.c_str(), other.c_str()) == 0 &&
                    ::rename(aside.c_str(), one.c_str()) == 0;
  return done ? 0 : errno;
}

int rename_over(const std::filesystem::path& from, const std::filesystem::path& to) {
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

}  // namespace rheocyte
