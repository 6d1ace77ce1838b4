// From a TOML file and `--set key=value` to a complete, checked case.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"
#include "case/given_keys.h"

namespace rheocyte {

/// Reads and checks a case file. Settings ("key=value") replace keys of the file; a key of the file that loses its
/// effect through a setting (viscosity_mPas after flow.law=power-law) is dropped silently.
/// UserError: one sentence with file, line, key, value, range and the nearest known key.
Case read_case(const std::filesystem::path& file, std::span<const std::string> settings = {});

/// The same from text; `name` stands for the file in messages.
Case parse_case(std::string_view text, const std::string& name, std::span<const std::string> settings = {});

/// The two steps of parse_case, for files that hold more than a case: the keys of the text with those of the settings
/// behind them, and the case that they state. Numbers that are left open stay unset and are not asked for.
std::vector<GivenKey> given_keys(std::string_view text, const std::string& name, std::span<const std::string> settings);
Case case_of_keys(std::vector<GivenKey> keys, const std::string& name, std::span<const std::string_view> left_open);

}  // namespace rheocyte
