// The case that a request states.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "case/case.h"

namespace rheocyte {

/// A case as JSON, sections nested or names dotted, with another accuracy if one is asked for. KeyError.
Case case_from_json(const nlohmann::ordered_json& tree, const std::string& accuracy = {});

/// The same cell so much stiffer that its state exists, where only a fraction of the requested compliance was reached:
/// all moduli, tension and bending stiffness by the same factor, in round numbers.
Case nearest_existing(Case, double reached);

}  // namespace rheocyte
