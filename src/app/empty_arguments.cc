#include "app/empty_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "app/cli.h"
#include "case/split.h"
#include "case/user_error.h"

namespace rheocyte {

namespace {

bool is_blank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == std::string_view::npos; }

void check_value(const CLI::Option& option, const std::string& spelling, std::string_view value) {
  if (is_blank(value))
    throw UserError(fmt::format("rheocyte: {} is empty; give a value, or leave the option out.", spelling));
  if (option.get_delimiter() == '\0') return;
  if (std::ranges::any_of(split(value, option.get_delimiter()), is_blank))
    throw UserError(fmt::format("rheocyte: {} {}: an entry of the list is empty.", spelling, one_line(value, 60)));
}

const CLI::App* subcommand_of(const CLI::App& command, std::string_view name) {
  const auto found = command.get_subcommands([name](const CLI::App* each) { return each->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

}  // namespace

void refuse_empty_arguments(const CLI::App& app, std::span<char* const> arguments) {
  const CLI::App* command = &app;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view word = arguments[i];
    if (is_blank(word)) throw UserError("rheocyte: an argument is empty; is a variable of the shell without a value?");
    if (const CLI::App* const below = subcommand_of(*command, word)) command = below;
    const auto equals = word.starts_with("--") ? word.find('=') : std::string_view::npos;
    const std::string spelling(word.substr(0, equals));
    const CLI::Option* const option = word.starts_with('-') ? command->get_option_no_throw(spelling) : nullptr;
    if (!option || option->get_items_expected_max() == 0) continue;  // of a flag
    if (equals != std::string_view::npos)
      check_value(*option, spelling, word.substr(equals + 1));
    else if (++i < arguments.size())
      check_value(*option, spelling, arguments[i]);
  }
}

}  // namespace rheocyte
