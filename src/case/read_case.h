// From a TOML file and `--set key=value` to a complete, checked case.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"
#include "case/key_reading.h"

namespace rheocyte {

/// Reads and checks a case file. Settings ("key=value") replace keys of the file; a key of the file that loses its
/// effect through a setting (viscosity_mPas after flow.law=power-law) is dropped silently.
/// UserError: one sentence with file, line, key, value, range and the nearest known key.
Case read_case(const std::filesystem::path& file, std::span<const std::string> settings = {});

/// The same from text; `name` stands for the file in messages.
Case parse_case(std::string_view text, const std::string& name, std::span<const std::string> settings = {});

/// The case that keys state, which may be those of more than a case. Numbers that are left open stay unset and are not
/// asked for.
Case complete_case(KeyReading& keys, std::vector<std::string_view> left_open = {});

}  // namespace rheocyte
