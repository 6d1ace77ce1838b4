// Options of the command line that state a quantity of a case or a spec: spelling, sentence, unit and range are the
// key's.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "case/key.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rheocyte {

/// Adds the option of a key that is a number; `take` gets the value. The former spelling is understood, with a remark
/// on standard error. UserError during parsing if the value is outside the range.
CLI::Option* add_key_option(CLI::App&, const KeyDescription&, const std::function<void(double)>& take);

/// The same for a value that may stay open; `otherwise` says in the help what holds then.
CLI::Option* add_key_option(CLI::App&, const KeyDescription&, std::optional<double>& target,
                            const std::string& otherwise);

/// An option for a number; its former spelling, if there is one, is understood, with a remark on standard error.
CLI::Option* add_number_option(CLI::App&, const std::string& spelling, const std::string& former,
                               const std::string& description, const std::function<void(double)>& take);

/// One of several options for the same quantity, with a spelling and a sentence of its own.
CLI::Option* add_key_option(CLI::App&, const KeyDescription&, const std::string& spelling, const std::string& sentence,
                            const std::function<void(double)>& take);

}  // namespace rheocyte
