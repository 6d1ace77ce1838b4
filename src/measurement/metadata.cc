#include "measurement/metadata.h"

#include <fmt/format.h>

#include <string_view>

#include "case/stripped.h"
#include "numeric/number_from_chars.h"

namespace rheocyte {

namespace {

constexpr std::string_view blanks(" \t\r\n\0", 5);

}  // namespace

std::optional<double> Metadata::number(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return std::nullopt;
  if (const auto* value = std::get_if<double>(&found->second)) return *value;
  const auto text = stripped(std::get<std::string>(found->second), blanks);
  double value = 0;
  const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::string> Metadata::text(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) return std::nullopt;
  if (const auto* value = std::get_if<double>(&found->second)) return fmt::format("{}", *value);
  const auto text = stripped(std::get<std::string>(found->second), blanks);
  return text.empty() ? std::nullopt : std::optional<std::string>(text);
}

}  // namespace rheocyte
