// CLI11, whose options take paths from texts in UTF-8.
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "case/to_path.h"

namespace CLI::detail {

template <>
inline bool lexical_cast(const std::string& input, std::filesystem::path& output) {
  output = rheocyte::to_path(input);
  return true;
}

}  // namespace CLI::detail
