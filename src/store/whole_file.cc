#include "store/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace rheocyte {

namespace {

// 0, or the number of the error.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const auto written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

int write_whole_file(const std::filesystem::path& scratch, const std::filesystem::path& path,
                     std::string_view content) {
  std::signal(SIGXFSZ, SIG_IGN);  // a quota or limit then is an error of write() like a full disk
  const int descriptor = ::open(scratch.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) return errno;
  int failed = write_all(descriptor, content);
  // Some file systems know no fsync; that is no loss of data.
  if (!failed && ::fsync(descriptor) != 0 && errno != EINVAL) failed = errno;
  if (::close(descriptor) != 0 && !failed) failed = errno;
  if (!failed && ::rename(scratch.c_str(), path.c_str()) != 0) failed = errno;
  if (failed) ::unlink(scratch.c_str());
  return failed;
}

}  // namespace rheocyte
