#include "case/parsed_toml.h"

#include <fmt/format.h>

#include "case/user_error.h"

namespace rheocyte {

toml::table parsed_toml(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw UserError(
        fmt::format("{}:{}: not valid TOML: {}", name, error.source().begin.line, one_line(error.description(), 200)));
  }
}

}  // namespace rheocyte
