// Cases on a line through a case, one number of it changed: for derivatives with respect to this number.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"

namespace rheocyte {

/// A case one number away from another one.
struct CasePoint {
  double change;  ///< of the key's value, in its unit
  double weight;  ///< derivative = sum of weight * value, over the points
  Case input;
};

/// The points of a formula of finite differences of second order: on both sides, or on one where the range of the key
/// ends or the unit of lengths (the lesser of width and height) has a kink.
std::vector<CasePoint> case_line(const Case&, std::string_view key);

/// The keys with respect to which a stationary case has derivatives: numbers of channel, flow and cell that it states
/// or that have a default, but for a bending stiffness of 0, where its effect begins.
std::vector<std::string_view> line_keys(const Case&);

/// Those that are asked for, each once; "all" stands for all. UserError for another key, and for a case in time or with
/// cell.place = "equilibrium", which have no derivatives; `name` stands for the case in it.
std::vector<std::string_view> asked_line_keys(const Case&, std::span<const std::string> keys, const std::string& name);

}  // namespace rheocyte
