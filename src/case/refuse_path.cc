#include "case/refuse_path.h"

#include <fmt/format.h>

#include "case/user_error.h"

namespace rheocyte {

void refuse_path(const std::filesystem::path& path, std::string_view reason) {
  throw UserError(fmt::format("{}: {}", one_line(path.string(), 300), reason));
}

void refuse_missing(const std::filesystem::path& recording) {
  // Of "https://" a path may have kept one slash; before that of a drive there is one letter.
  const auto scheme = recording.string().find(":/");
  const bool is_address = scheme != std::string::npos && scheme > 1;
  refuse_path(recording, is_address ? "is an address on a network; download the recording and give the file."
                                    : "there is no such file.");
}

}  // namespace rheocyte
