// A state for the page: numbers, outlines and fields.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "result/result.h"

namespace rheocyte {

/// result.json's keys, with "contour" and "hull", closed and about the contour's centroid, and in a square channel
/// "contours" from both sides.
nlohmann::ordered_json state_json(const Result&);

/// "fields": values at points of straight triangles, as base64, about the same centroid. One line; empty without a
/// state.
std::string fields_json(const Result&);

/// A contour in time likewise, in um.
nlohmann::ordered_json outline_json(const Contour&, double um);

}  // namespace rheocyte
