#include "app/key_option.h"

#include <fmt/format.h>

#include "app/cli.h"
#include "case/user_error.h"
#include "store/standard_error.h"

namespace rheocyte {

namespace {

std::function<void(double)> within_range(const KeyDescription& key, const std::string& spelling,
                                         const std::function<void(double)>& take) {
  return [spelling, &key, take](double value) {
    const Range& range = std::get<Number>(key.kind).range;
    if (!range.contains(value))
      throw UserError(fmt::format("rheocyte: {} {:g} is outside its range {} ({}).", spelling, value,
                                  range_text(range, key.unit), key.sentence));
    take(value);
  };
}

}  // namespace

CLI::Option* add_number_option(CLI::App& command, const std::string& spelling, const std::string& former,
                               const std::string& description, const std::function<void(double)>& take) {
  const auto add = [&command](const std::string& name, const std::string& text, const auto& take_it) {
    return command.add_option_function<double>(name, take_it, text)->type_name("NUMBER");
  };
  auto* const option = add(spelling, description, take);
  if (former.empty()) return option;
  add(former, "", [&command, option, spelling, former, take](double value) {
    if (option->count() > 0)
      throw UserError(fmt::format("rheocyte: {} is the former name of {}; give one of them.", former, spelling));
    const auto* const quiet = command.get_option_no_throw("--quiet");
    if (!quiet || quiet->count() == 0)
      tell(fmt::format("rheocyte: {} is now called {}; this version still reads the old name.", former, spelling));
    take(value);
  })->group("");
  return option;
}

CLI::Option* add_key_option(CLI::App& command, const KeyDescription& key, const std::string& spelling,
                            const std::string& sentence, const std::function<void(double)>& take) {
  return add_number_option(command, spelling, {}, sentence, within_range(key, spelling, take));
}

CLI::Option* add_key_option(CLI::App& command, const KeyDescription& key, const std::function<void(double)>& take) {
  const std::string spelling(key.option);
  return add_number_option(command, spelling, std::string(key.former_option),
                           fmt::format("{} ({})", key.sentence, allowed_values(key)),
                           within_range(key, spelling, take));
}

CLI::Option* add_key_option(CLI::App& command, const KeyDescription& key, std::optional<double>& target,
                            const std::string& otherwise) {
  auto* option = add_key_option(command, key, [&target](double value) { target = value; });
  return option->description(fmt::format("{}; default: {}", option->get_description(), otherwise));
}

}  // namespace rheocyte
