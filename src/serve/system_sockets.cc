#include "serve/system_sockets.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace rheocyte {

namespace {

/// An end of a connection as the system's table writes it: the words of its address and the port; IPv4 stands in two
/// forms.
std::vector<std::string> table_names(const sockaddr_storage& end) {
  if (end.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(end);
    const std::string name = fmt::format("{:08X}:{:04X}", v4.sin_addr.s_addr, ntohs(v4.sin_port));
    return {name, fmt::format("{:016X}{:08X}{}", 0, htonl(0xFFFF), name)};
  }
  const auto& v6 = reinterpret_cast<const sockaddr_in6&>(end);
  std::array<std::uint32_t, 4> words{};
  std::memcpy(words.data(), &v6.sin6_addr, sizeof v6.sin6_addr);
  return {fmt::format("{:08X}{:08X}{:08X}{:08X}:{:04X}", words[0], words[1], words[2], words[3], ntohs(v6.sin6_port))};
}

/// Whether a line is that of the socket at the other end: "N: theirs ours state queues timer retries user ...".
bool is_line_of_own(const std::string& line, const std::vector<std::string>& theirs,
                    const std::vector<std::string>& ours) {
  std::istringstream stream(line);
  const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  constexpr std::size_t user = 7;
  if (words.size() <= user || words[user] != std::to_string(::getuid())) return false;
  for (std::size_t form = 0; form < theirs.size() && form < ours.size(); ++form)
    if (words[1] == theirs[form] && words[2] == ours[form]) return true;
  return false;
}

}  // namespace

bool peer_is_own_user(SystemSocket peer) {
  const int socket = static_cast<int>(peer);
  sockaddr_storage theirs{}, ours{};
  socklen_t length_of_theirs = sizeof theirs, length_of_ours = sizeof ours;
  if (::getpeername(socket, reinterpret_cast<sockaddr*>(&theirs), &length_of_theirs) != 0 ||
      ::getsockname(socket, reinterpret_cast<sockaddr*>(&ours), &length_of_ours) != 0)
    return false;
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream stream(table);
    for (std::string line; std::getline(stream, line);)
      if (is_line_of_own(line, table_names(theirs), table_names(ours))) return true;
  }
  return false;
}

bool peer_has_left(SystemSocket peer) {
  pollfd asked{static_cast<int>(peer), POLLRDHUP, 0};
  return ::poll(&asked, 1, 0) > 0 && (asked.revents & (POLLRDHUP | POLLHUP | POLLERR | POLLNVAL)) != 0;
}

void keep_to_this_process(SystemSocket socket) { ::fcntl(static_cast<int>(socket), F_SETFD, FD_CLOEXEC); }

}  // namespace rheocyte
