#include "store/claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

namespace rheocyte {

namespace {

Claim opened(const std::filesystem::path& path, int how) {
  return Claim(::open(path.c_str(), how | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
}

}  // namespace

Claim::Claim(Claim&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

Claim& Claim::operator=(Claim&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

Claim::~Claim() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Claim claim_on(const std::filesystem::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0 || (!S_ISDIR(found.st_mode) && !S_ISREG(found.st_mode))) return {};
  // Network file systems lock only what is open for writing.
  Claim claim = opened(path, S_ISDIR(found.st_mode) ? O_RDONLY | O_DIRECTORY : O_RDWR);
  if (claim && ::flock(claim.descriptor(), LOCK_EX | LOCK_NB) == 0) return claim;
  return {};
}

Claim wait_for_folder(const std::filesystem::path& path) {
  Claim claim = opened(path.empty() ? "." : path, O_RDONLY | O_DIRECTORY);
  if (claim) ::flock(claim.descriptor(), LOCK_EX);
  return claim;
}

}  // namespace rheocyte
