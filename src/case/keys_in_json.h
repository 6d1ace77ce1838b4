// The keys of a case that a program states as JSON.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "case/given_keys.h"

namespace rheocyte {

/// All keys of a tree whose sections are objects, {"cell": {"radius_um": 7.66}}, or parts of names, {"cell.radius_um":
/// 7.66}; null is not given. `where` stands for the file in messages.
std::vector<GivenKey> keys_in_json(const nlohmann::ordered_json& tree, const std::string& where);

}  // namespace rheocyte
