#include "app/key_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "case/user_error.h"
#include "store/standard_error.h"

namespace rheocyte {

CLI::Option* add_key_option(CLI::App& command, const KeyDescription& key, const std::string& spelling,
                            const std::string& sentence, const std::function<void(double)>& take) {
  const auto checked_take = [spelling, &key, take](const double& value) {
    const Range& range = std::get<Number>(key.kind).range;
    if (!range.contains(value))
      throw UserError(fmt::format("rheocyte: {} {:g} is outside its range {} ({}).", spelling, value,
                                  range_text(range, key.unit), key.sentence));
    take(value);
  };
  return command.add_option_function<double>(spelling, checked_take, sentence)->type_name("NUMBER");
}

CLI::Option* add_key_option(CLI::App& command, const KeyDescription& key, const std::function<void(double)>& take) {
  const std::string spelling(key.option), former(key.former_option);
  auto* option =
      add_key_option(command, key, spelling, fmt::format("{} ({})", key.sentence, allowed_values(key)), take);
  if (former.empty()) return option;
  const auto take_and_tell = [&command, option, spelling, former, take](double value) {
    if (option->count() > 0)
      throw UserError(fmt::format("rheocyte: {} is the former name of {}; give one of them.", former, spelling));
    const auto* const quiet = command.get_option_no_throw("--quiet");
    if (!quiet || quiet->count() == 0)
      tell(fmt::format("rheocyte: {} is now called {}; this version still reads the old name.", former, spelling));
    take(value);
  };
  add_key_option(command, key, former, "", take_and_tell)->group("");
  return option;
}

CLI::Option* add_key_option(CLI::App& command, const KeyDescription& key, std::optional<double>& target,
                            const std::string& otherwise) {
  auto* option = add_key_option(command, key, [&target](double value) { target = value; });
  return option->description(fmt::format("{}; default: {}", option->get_description(), otherwise));
}

}  // namespace rheocyte
