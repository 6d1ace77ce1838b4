#include "store/packets.h"

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "store/system_limit.h"

namespace rheocyte {

namespace {

constexpr std::size_t longest_piece = std::size_t{1} << 16U;  // packets of this size always fit

}  // namespace

PacketSockets::PacketSockets() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) throw SystemLimit("open files", errno);
  ours = ends[0];
  theirs = ends[1];
}

bool send_packet(int socket, Word word, std::string_view text) {
  char packet[1 + longest_piece];
  text = text.substr(0, longest_piece);
  packet[0] = static_cast<char>(word);
  if (!text.empty()) std::memcpy(packet + 1, text.data(), text.size());
  for (;;) {
    if (::send(socket, packet, 1 + text.size(), MSG_NOSIGNAL) >= 0) return true;
    if (errno != EINTR) return false;
  }
}

bool send_pieces(int socket, Word word, std::string_view text) {
  for (std::size_t at = 0; at < text.size(); at += longest_piece)
    if (!send_packet(socket, word, text.substr(at, longest_piece))) return false;
  return true;
}

bool send_progress(int socket, double fraction) {
  return send_packet(socket, Word::progress, {reinterpret_cast<const char*>(&fraction), sizeof fraction});
}

Packet receive_packet(int socket, int wait_ms) {
  char packet[1 + longest_piece];
  for (;;) {
    pollfd awaited{socket, POLLIN, 0};
    const int ready = ::poll(&awaited, 1, wait_ms);
    if (ready == 0) return {Word::none, {}};
    const ssize_t count = ready < 0 ? -1 : ::recv(socket, packet, sizeof packet, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return {Word::closed, {}};
    return {static_cast<Word>(packet[0]), {packet + 1, static_cast<std::size_t>(count) - 1}};
  }
}

double progress_in(const Packet& packet) {
  double fraction = 0;
  if (packet.text.size() == sizeof fraction) std::memcpy(&fraction, packet.text.data(), sizeof fraction);
  return fraction;
}

}  // namespace rheocyte
