// A case as text: for result.json, for a copy that can be read again, and as the fingerprint of a result.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "case/case.h"

namespace rheocyte {

/// All keys that have an effect in this case, nested as in the file: {"channel": {"width_um": 20.0}, ...}.
nlohmann::ordered_json to_json(const Case&);

/// The same as a TOML file that read_case reads back to the same bits.
std::string to_toml(const Case&);

/// The fingerprint of the resolved case; equal cases have equal hashes, whatever their files look like.
std::string case_hash(const Case&);

}  // namespace rheocyte
