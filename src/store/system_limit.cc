#include "store/system_limit.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace rheocyte {

namespace {

std::string way_out(int reason) {
  if (reason == EMFILE) return "lift the limit of this program (ulimit -n)";
  if (reason == ENOMEM) return "end other programs, or lift the limit of the memory (ulimit -v)";
  return "end other programs, or lift the limit (ulimit -u, that of a container, or ulimit -v)";
}

}  // namespace

SystemLimit::SystemLimit(std::string_view what, int reason)
    : UserError(fmt::format("The system gives no more {} ({}); {}.", what, std::generic_category().message(reason),
                            way_out(reason))) {}

void check_open_files(int reason) {
  if (reason == EMFILE || reason == ENFILE) throw SystemLimit("open files", reason);
}

}  // namespace rheocyte
