// The plugin file for dclab and DCscope, which works where rheocyte is not installed (docs/python.md, sec. "With
// dclab").
#pragma once
#include <string>

namespace rheocyte {

/// What stands behind the program text python/rheocyte/modulus_plugin.py in the file: lines of Python with the shipped
/// tables of the square channel, the laws of the pixels and the limits of what is measured. UserError if the tables are
/// missing or damaged.
std::string data_of_dclab_plugin();

}  // namespace rheocyte
