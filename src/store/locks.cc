// Claims by the locks of POSIX.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "store/claim.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

Claim opened(const fs::path& path, int how) {
  return Claim(::open(path.c_str(), how | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
}

// EWOULDBLOCK if another process has taken what was just made for a left-over, and holds or has removed it.
Claiming held(Claim made, const fs::path& path) {
  const bool is_held_by_another = ::flock(made.descriptor(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  struct stat found {};
  if (is_held_by_another || ::lstat(path.c_str(), &found) != 0) return {{}, EWOULDBLOCK};
  return {std::move(made), 0};
}

}  // namespace

Claim claim_on(const fs::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0 || (!S_ISDIR(found.st_mode) && !S_ISREG(found.st_mode))) return {};
  // Network file systems lock only what is open for writing.
  Claim claim = opened(path, S_ISDIR(found.st_mode) ? O_RDONLY | O_DIRECTORY : O_RDWR);
  if (claim && ::flock(claim.descriptor(), LOCK_EX | LOCK_NB) == 0) return claim;
  return {};
}

Claim wait_for_folder(const fs::path& path) {
  Claim claim = opened(path.empty() ? "." : path, O_RDONLY | O_DIRECTORY);
  if (claim) ::flock(claim.descriptor(), LOCK_EX);
  return claim;
}

Claiming claim_on_mark(const fs::path& path, IfHeld if_held) {
  Claim claim(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!claim || ::flock(claim.descriptor(), if_held == IfHeld::wait ? LOCK_EX : LOCK_EX | LOCK_NB) != 0)
    return {{}, errno};
  return {std::move(claim), 0};
}

Claiming make_claimed_file(const fs::path& path) {
  Claim made(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  return made ? held(std::move(made), path) : Claiming{{}, errno};
}

Claiming make_claimed_folder(const fs::path& path) {
  if (::mkdir(path.c_str(), 0700) != 0) return {{}, errno};
  Claim made(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (made) return held(std::move(made), path);
  return {{}, errno == ENOENT ? EWOULDBLOCK : errno};  // removed before it could be opened
}

}  // namespace rheocyte
