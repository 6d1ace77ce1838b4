#include "case/write_case.h"

#include <nlohmann/json.hpp>

#include "case/case_keys.h"
#include "case/write_keys.h"
#include "numeric/fingerprint.h"

namespace rheocyte {

nlohmann::ordered_json to_json(const Case& c) { return to_json(values_of(c, case_keys())); }

std::string to_toml(const Case& c) { return to_toml(values_of(c, case_keys())); }

std::string case_hash(const Case& c) { return fingerprint(to_toml(c)); }

}  // namespace rheocyte
