// The keys that the user gave, flat, before anything is known about their meaning.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/case_text.h"

namespace rheocyte {

/// A value that no parameter takes; the text says what it is, e.g. "an array".
struct Unusable {
  std::string what;
};

struct GivenKey {
  std::string key;    ///< dotted
  std::string where;  ///< "case.toml:7" or "--set"
  std::variant<double, std::string, std::vector<double>, Unusable> value;
  bool from_set = false;
};

/// All keys of a TOML text in the order of the file, and those of `--set` behind them. UserError if the text is no TOML
/// or harmful (case/case_text.h).
std::vector<GivenKey> given_keys(std::string_view text, const std::string& name,
                                 std::span<const std::string> settings = {}, const TextKind& kind = {});

/// All keys of a TOML text in the order of the file. UserError with the line if the text is no TOML.
/// The text must have passed check_case_text.
std::vector<GivenKey> keys_in_toml(std::string_view text, const std::string& name);

/// One `--set key=value`; a value that reads as a number is one, [a, b] is a list of numbers, quotes round a word are
/// optional.
GivenKey key_in_setting(std::string_view setting);

/// The value as the user would write it, on one line and not too long.
std::string value_text(const GivenKey&);

}  // namespace rheocyte
