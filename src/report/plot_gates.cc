#include "report/plot_gates.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "events/gates.h"

namespace rheocyte {

using Json = nlohmann::ordered_json;

Json gates_in_picture(const PlotOptions& options) {
  const Gates gates(options.measuring.gates);
  const auto limits = [&](const std::string& feature) {
    const auto [min, max] = gates.limits_of(feature);
    return Json::array({std::isfinite(min) ? Json(min) : Json(), std::isfinite(max) ? Json(max) : Json()});
  };
  Json polygons = Json::array();
  for (const auto& outline : gates.outlines_over(options.x, options.y)) {
    Json& polygon = polygons.emplace_back(Json{{"x", Json::array()}, {"y", Json::array()}});
    for (const auto& corner : outline) {
      polygon["x"].push_back(corner.x);
      polygon["y"].push_back(corner.y);
    }
  }
  return {{"x", limits(options.x)}, {"y", limits(options.y)}, {"polygons", polygons}};
}

}  // namespace rheocyte
