#include "serve/http.h"

#include <fmt/format.h>

#include <charconv>

#include "case/json_guard.h"

namespace rheocyte {

std::size_t Request::number(std::string_view name) const {
  const auto found = parts.find(name);
  const std::string text = found == parts.end() ? "" : found->second;
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size())
    throw Refused(404, "unknown", "There is no such " + std::string(name) + ": it needs a whole number.");
  return value;
}

std::string Request::asked(std::string_view name, std::string_view otherwise) const {
  const auto found = query.find(name);
  return found == query.end() ? std::string(otherwise) : found->second;
}

nlohmann::ordered_json Request::json() const {
  nlohmann::ordered_json tree = parse_sound_json(body);
  if (!tree.is_object())
    throw Refused(
        400, "json",
        fmt::format("The body of the request is not a JSON object, or it nests deeper than {} levels or has more "
                    "than {} keys in one object.",
                    max_json_nesting, max_json_keys));
  return tree;
}

Refused::Refused(int s, std::string_view r, const std::string& sentence)
    : std::runtime_error(sentence), status(s), reason(r) {}

Answer json_answer(const nlohmann::ordered_json& tree, int status) {
  return {.status = status, .body = json_line(tree)};
}

Answer refusal(int status, std::string_view reason, std::string_view sentence) {
  return json_answer({{"error", sentence}, {"reason", reason}}, status);
}

}  // namespace rheocyte
