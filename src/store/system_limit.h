// What the system does not give.
#pragma once
#include <string_view>

#include "case/user_error.h"

namespace rheocyte {

/// The system gives no more threads, processes or open files; the user can lift the limit or end other programs.
class SystemLimit final : public UserError {
 public:
  /// `what` is missing ("threads", "processes", "open files"), `reason` is the number of the error (errno).
  SystemLimit(std::string_view what, int reason);
};

}  // namespace rheocyte
