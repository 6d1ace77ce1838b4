#include "serve/answer_text.h"

#include <fmt/format.h>

namespace rheocyte {

namespace {

constexpr std::string_view usual_headers =
    "Content-Security-Policy: default-src 'self'; img-src 'self' blob: data:; style-src 'self'; worker-src 'self' "
    "blob:; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Cross-Origin-Opener-Policy: same-origin\r\n";

constexpr int not_modified = 304;

}  // namespace

std::string head_text(const Answer& answer, std::string_view reason, Length length, bool is_last) {
  std::string text = fmt::format("HTTP/1.1 {} {}\r\n", answer.status, reason).append(usual_headers);
  for (const auto& [name, value] : answer.headers) text.append(name).append(": ").append(value).append("\r\n");
  text.append("Content-Type: ").append(answer.type).append("\r\n");
  if (length == Length::pieces) text.append("Transfer-Encoding: chunked\r\n");
  // Without a body 304 has the length of the answer that it stands for.
  if (length == Length::known && answer.status != not_modified)
    text.append("Content-Length: ").append(std::to_string(answer.body.size())).append("\r\n");
  return text.append(is_last ? "Connection: close\r\n\r\n" : "Connection: keep-alive\r\n\r\n");
}

}  // namespace rheocyte
