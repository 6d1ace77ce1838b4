#include "store/last_line.h"

namespace rheocyte {

void keep_tail(std::string& tail, std::string_view piece) {
  constexpr std::size_t kept = 4096;
  tail.append(piece);
  if (tail.size() > kept) tail.erase(0, tail.size() - kept);
}

std::string last_line_of(const std::string& tail) {
  const auto end = tail.find_last_not_of("\r\n ");
  if (end == std::string::npos) return {};
  const auto before = tail.rfind('\n', end), start = before == std::string::npos ? 0 : before + 1;
  return tail.substr(start, end - start + 1);
}

}  // namespace rheocyte
