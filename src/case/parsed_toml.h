// A text as TOML, or the sentence with the line why it is none.
#pragma once
#include <string>
#include <string_view>

#include "case/toml_parser.h"

namespace rheocyte {

/// `name` is that of the file. UserError with the line if the text is no TOML.
toml::table parsed_toml(std::string_view text, const std::string& name);

}  // namespace rheocyte
