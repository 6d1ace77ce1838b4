// A table's file as this version writes it.
#pragma once
#include <string>
#include <string_view>

namespace rheocyte {

/// Of a file that this or a former version has written; the beginning of its name (grid_, elongated_, combined_,
/// dynamic_) says what it is. UserError if it is damaged or none of these.
std::string rewritten_table(std::string_view bytes, const std::string& name);

}  // namespace rheocyte
