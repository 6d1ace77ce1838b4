// toml++ without its assertions. Version 3.3 states some of them about the text itself ("a key begins with a letter"):
// a damaged file would abort a debug build and, with Clang, be undefined behaviour in a release build, although the
// parser reports the error properly a few lines later. Include it only where TOML is parsed.
#pragma once

#pragma push_macro("NDEBUG")
#undef NDEBUG  // otherwise toml++ defines its own TOML_ASSERT
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
