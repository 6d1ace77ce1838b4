#include "store/isolated_messages.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace rheocyte {

namespace {

struct Header {
  MessageKind message = MessageKind::progress;
  std::uint64_t length = 0;
};

}  // namespace

void send(int pipe, MessageKind message, std::string_view text) {
  std::string bytes(sizeof(Header) + text.size(), '\0');
  Header header{};
  header.message = message;
  header.length = text.size();
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, text.data(), text.size());
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(pipe, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno != EINTR) ::_exit(1);  // the parent is gone
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

void send_progress(int pipe, double fraction) {
  send(pipe, MessageKind::progress, {reinterpret_cast<const char*>(&fraction), sizeof fraction});
}

void send_want_of_memory(int pipe) {
  Header header{};
  header.message = MessageKind::no_memory;
  static_cast<void>(!::write(pipe, &header, sizeof header));
}

bool IsolatedInbox::read_from(int pipe) {
  char buffer[65536];
  const ssize_t count = ::read(pipe, buffer, sizeof buffer);
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  if (count == 0) return false;
  bytes_.append(buffer, static_cast<std::size_t>(count));
  while (take_message()) {
  }
  return true;
}

bool IsolatedInbox::take_message() {
  Header header{};
  if (bytes_.size() < sizeof header) return false;
  std::memcpy(&header, bytes_.data(), sizeof header);
  if (header.length > longest_ || bytes_.size() < sizeof header + header.length) return false;
  const std::string text = bytes_.substr(sizeof header, header.length);
  bytes_.erase(0, sizeof header + header.length);
  if (header.message == MessageKind::progress) {
    double fraction = 0;
    if (text.size() == sizeof fraction) std::memcpy(&fraction, text.data(), sizeof fraction);
    on_progress_(fraction);
    return true;
  }
  end_.text = text;
  end_.kind = header.message == MessageKind::result       ? IsolatedEnd::Kind::finished
              : header.message == MessageKind::user_error ? IsolatedEnd::Kind::user_error
              : header.message == MessageKind::no_memory  ? IsolatedEnd::Kind::no_memory
                                                          : IsolatedEnd::Kind::own_error;
  has_end_ = true;
  return true;
}

}  // namespace rheocyte
