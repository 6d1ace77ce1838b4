// How a user says which events are taken (events/gates.h).
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rheocyte {

/// As on the command line: limits "area_ratio=1.05", polygons "area_um,deform=40,0.01:90,0.01:90,0.1"
/// or files of them, "filters.poly".
struct GateOptions {
  std::vector<std::string> min, max, polygons = {};
  std::optional<std::vector<std::size_t>> events = {};  ///< the only ones that are taken, counted from 0
};

}  // namespace rheocyte
