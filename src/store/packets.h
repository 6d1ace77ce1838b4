// Messages between a process and those that it has forked: each is one packet on a socket, so that two may answer in
// turn and one that breaks leaves no half message.
#pragma once
#include <string>
#include <string_view>

namespace rheocyte {

/// What a packet is, its first byte.
enum class Word : char {
  request = 'q',  ///< a piece of it
  request_end = 'r',
  piece = 'd',  ///< of the answer
  progress = 'p',
  done = 'f',
  user_error = 'e',  ///< with the sentence, as what follows
  own_error = 'o',
  limit = 'l',
  no_memory = 'm',
  closed = 'c',  ///< never sent: the other end is closed,
  none = 'n'     ///< or has sent nothing in time
};

struct Packet {
  Word word;
  std::string text;
};

/// Both ends. SystemLimit.
struct PacketSockets {
  PacketSockets();
  int ours = -1, theirs = -1;
};

/// False once the other end is closed. Texts may have 64 KiB; pieces may have any length.
bool send_packet(int socket, Word word, std::string_view text = {});
bool send_pieces(int socket, Word word, std::string_view text);
bool send_progress(int socket, double fraction);

/// Waits for so many milliseconds at most; -1: as long as it takes.
Packet receive_packet(int socket, int wait_ms);
double progress_in(const Packet& packet);

}  // namespace rheocyte
