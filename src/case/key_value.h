// One value of a key, checked by itself.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "case/given_keys.h"
#include "case/key.h"
#include "case/user_error.h"

namespace rheocyte {

/// The parts of a spread, as they stand behind its key: ".mean", ".sd", ".distribution".
std::span<const std::string_view> spread_parts();

/// What is wrong with one key.
class KeyError : public UserError {
 public:
  KeyError(std::string_view name, const std::string& sentence) : UserError(sentence), key(name) {}
  std::string key;  ///< dotted
};

/// KeyError that begins with the place of the key.
[[noreturn]] void refuse(const GivenKey&, const std::string& reason);

/// For example: `cell.radius_um = 0.001`, not too long.
std::string stated(const GivenKey&);

/// The value of a key that is no spread. UserError if it is not a good one.
Value checked_value(const KeyDescription&, const GivenKey&);

/// The spread of a key from the parts that are given.
Spread checked_spread(const KeyDescription&, std::span<const GivenKey> parts);

}  // namespace rheocyte
