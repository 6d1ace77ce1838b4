// After it the others.
#include <winsock2.h>
//
#include <iphlpapi.h>
#include <windows.h>

#include <memory>
#include <vector>

#include "serve/system_sockets.h"

namespace rheocyte {

namespace {

SOCKET socket_of(SystemSocket socket) { return static_cast<SOCKET>(socket); }

struct CloseHandles {
  void operator()(void* handle) const { ::CloseHandle(handle); }
};
using Handle = std::unique_ptr<void, CloseHandles>;

/// The user for whom a process runs, as bytes that are the same for one user; empty if that is not known.
std::vector<unsigned char> user_of(DWORD process) {
  const Handle opened(::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, process));
  HANDLE token = nullptr;
  if (!opened || !::OpenProcessToken(opened.get(), TOKEN_QUERY, &token)) return {};
  const Handle closes(token);
  DWORD size = 0;
  ::GetTokenInformation(token, TokenUser, nullptr, 0, &size);
  std::vector<unsigned char> bytes(size);
  if (size == 0 || !::GetTokenInformation(token, TokenUser, bytes.data(), size, &size)) return {};
  PSID const user = reinterpret_cast<TOKEN_USER*>(bytes.data())->User.Sid;
  const auto* const first = static_cast<const unsigned char*>(user);
  return {first, first + ::GetLengthSid(user)};
}

/// The process that has the other end of a connection on this machine; 0 if there is none. Of IPv4.
DWORD process_at(const sockaddr_in& theirs, const sockaddr_in& ours) {
  DWORD size = 0;
  ::GetExtendedTcpTable(nullptr, &size, FALSE, AF_INET, TCP_TABLE_OWNER_PID_ALL, 0);
  std::vector<unsigned char> bytes(size + 4096);
  size = static_cast<DWORD>(bytes.size());
  if (::GetExtendedTcpTable(bytes.data(), &size, FALSE, AF_INET, TCP_TABLE_OWNER_PID_ALL, 0) != NO_ERROR) return 0;
  const auto* const table = reinterpret_cast<const MIB_TCPTABLE_OWNER_PID*>(bytes.data());
  for (DWORD i = 0; i < table->dwNumEntries; ++i) {
    const auto& row = table->table[i];
    if (row.dwLocalAddr == theirs.sin_addr.s_addr && row.dwLocalPort == theirs.sin_port &&
        row.dwRemoteAddr == ours.sin_addr.s_addr && row.dwRemotePort == ours.sin_port)
      return row.dwOwningPid;
  }
  return 0;
}

}  // namespace

bool peer_is_own_user(SystemSocket socket) {
  sockaddr_in theirs{}, ours{};
  int length_of_theirs = sizeof theirs, length_of_ours = sizeof ours;
  if (::getpeername(socket_of(socket), reinterpret_cast<sockaddr*>(&theirs), &length_of_theirs) != 0 ||
      ::getsockname(socket_of(socket), reinterpret_cast<sockaddr*>(&ours), &length_of_ours) != 0 ||
      theirs.sin_family != AF_INET)
    return false;
  const DWORD process = process_at(theirs, ours);
  const auto user = process != 0 ? user_of(process) : std::vector<unsigned char>();
  return !user.empty() && user == user_of(::GetCurrentProcessId());
}

bool peer_has_left(SystemSocket socket) {
  WSAPOLLFD asked{socket_of(socket), POLLRDNORM, 0};
  if (::WSAPoll(&asked, 1, 0) <= 0) return false;
  if ((asked.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) return true;
  char byte = 0;
  return ::recv(socket_of(socket), &byte, 1, MSG_PEEK) <= 0;
}

void keep_to_this_process(SystemSocket socket) {
  ::SetHandleInformation(reinterpret_cast<HANDLE>(socket), HANDLE_FLAG_INHERIT, 0);
}

}  // namespace rheocyte
