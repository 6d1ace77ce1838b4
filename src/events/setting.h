// The declaration of a setting of the commands that read recordings: what the user may say, and where it goes. Options
// of the command line, the JSON of the view with its fields, and the arguments of Python are all made from lists of
// these (events/recording_settings.h).
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/choices.h"
#include "case/key.h"

namespace rheocyte {

/// As it is given, regardless of the source.
using SettingValue = std::variant<bool, double, std::string, std::vector<std::string>, std::vector<double>>;

/// A number or a text that may stay open, a text that is empty then, texts, the section of the channel, a flag; a
/// number that has a value of its own, or is NaN and must be given; numbers.
using SettingPlace =
    std::variant<std::optional<double>*, std::optional<std::string>*, std::string*, std::vector<std::string>*,
                 std::optional<Section>*, bool*, double*, std::vector<double>*>;

struct Setting {
  std::string_view name = {};   ///< the option has "-" for "_"
  std::string_view label = {};  ///< for the eye: that of the page's field
  SettingPlace place = static_cast<bool*>(nullptr);
  std::string_view sentence = {};            ///< what it is
  std::string_view otherwise = {};           ///< what holds if it is not given, unless its place says that
  std::string_view type_name = {};           ///< what stands behind the option in the help
  std::string_view unit = {};                ///< of numbers, and of texts that can be one
  std::vector<std::string_view> words = {};  ///< those that are understood, or the common ones
  bool is_usual = false;                     ///< the page shows its field at once
  std::string_view former_name = {};         ///< still read in Python, where former flags say the opposite
  std::string_view former_option = {};       ///< still read
  char separator = 0;                        ///< of several in one option; 0: one each
  Range range{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};

using Settings = std::vector<Setting>;

/// "--channel-width-um"
std::string option_of(const Setting&);

/// What holds if it is not given; empty of what must be given, and of flags.
std::string default_of(const Setting&);

/// The sentence with the range and what holds otherwise.
std::string description_of(const Setting&);

/// Puts a value in its place; a number may stand for a text. UserError that begins with `what`, which names the
/// setting: a value of another kind, a number outside its range, a word that is none.
void take(const Setting&, const SettingValue&, const std::string& what);

/// Nothing if it is not given.
std::optional<SettingValue> value_of(const Setting&);

}  // namespace rheocyte
