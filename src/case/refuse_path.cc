#include "case/refuse_path.h"

#include <fmt/format.h>

#include "case/user_error.h"

namespace rheocyte {

void refuse_path(const std::filesystem::path& path, std::string_view reason) {
  throw UserError(fmt::format("{}: {}", one_line(path.string(), 300), reason));
}

}  // namespace rheocyte
