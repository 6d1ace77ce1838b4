// What isolated work tells the process that started it, through a pipe.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "store/isolated.h"
#include "store/progress.h"

namespace rheocyte {

enum class MessageKind : char { progress = 'p', result = 'r', user_error = 'u', own_error = 'o', no_memory = 'm' };

/// Ends the process where nobody reads any more.
void send(int pipe, MessageKind message, std::string_view text);
void send_progress(int pipe, double fraction);
/// Takes no memory.
void send_want_of_memory(int pipe);

/// Puts messages together from what arrives in pieces.
class IsolatedInbox {
 public:
  /// `longest`: of a message in bytes; a child that broke down may announce anything.
  IsolatedInbox(const TellProgress& on_progress, std::uint64_t longest)
      : on_progress_(on_progress), longest_(longest) {}

  /// False at the end of the pipe.
  bool read_from(int pipe);

  bool has_end() const { return has_end_; }
  const IsolatedEnd& end() const { return end_; }

 private:
  bool take_message();

  const TellProgress& on_progress_;
  std::uint64_t longest_;
  std::string bytes_;
  IsolatedEnd end_;
  bool has_end_ = false;
};

}  // namespace rheocyte
