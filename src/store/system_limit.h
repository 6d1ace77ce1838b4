// What the system does not give.
#pragma once
#include <string>
#include <string_view>

#include "case/user_error.h"

namespace rheocyte {

inline constexpr const char* memory_does_not_suffice = "The memory of this machine does not suffice.";

/// The system gives no more threads, processes, open files or memory; the user can lift the limit or end other
/// programs.
class SystemLimit final : public UserError {
 public:
  /// `what` is missing ("threads", "processes", "open files"), `reason` is the number of the error (errno).
  SystemLimit(std::string_view what, int reason);
  /// The sentence of another process, which met the limit.
  explicit SystemLimit(const std::string& sentence) : UserError(sentence) {}
};

/// SystemLimit if a file could not be opened because the process, or the system, has too many open; `reason` is errno.
void check_open_files(int reason);

}  // namespace rheocyte
