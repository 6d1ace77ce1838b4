// Polygon filters as dclab and DCscope save them (.poly).
#pragma once
#include <string>
#include <vector>

#include "events/polygon_gate.h"

namespace rheocyte {

/// Whether the text is the name of a file of polygon filters, not a description of a polygon.
inline bool is_polygon_file(const std::string& text) { return text.ends_with(".poly"); }

/// The polygons that a text means: those of a file whose name ends in .poly, all of which an event has to pass, else
/// the one that it describes (PolygonGate). UserError: there is no such file, it is none of polygons, or it is damaged.
std::vector<PolygonGate> polygon_gates(const std::string& text);

}  // namespace rheocyte
