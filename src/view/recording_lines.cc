#include "view/recording_lines.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "case/user_error.h"
#include "extract/plot_lines.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

Json none(const std::string& sentence) {
  return {{"lines", Json::array()}, {"range", nullptr}, {"table", nullptr}, {"sentence", sentence}};
}

Json as_xy(const nlohmann::json& points) { return {{"x", points.at("area_um2")}, {"y", points.at("deformation")}}; }

}  // namespace

Json recording_lines(const Recording& recording, const ExtractOptions& options, const std::string& x,
                     const std::string& y) {
  PlotOptions plot;
  plot.measuring = options.measuring;
  plot.table = options.table;
  plot.no_pixelation = options.no_pixelation;
  plot.x = x;
  plot.y = y;
  if (!has_usual_axes(plot)) return none("There are isoelasticity lines over area_um and deform only.");
  PlotLines lines(plot);
  PlotPanel panel;
  if (is_of_the_reservoir(recording)) return none("was recorded in the reservoir, where no isoelasticity lines exist.");
  try {
    take_conditions(recording, plot, panel);
  } catch (const UserError& missing) {
    return none(missing.what());
  }
  const nlohmann::json drawn = lines.for_panel(panel);
  Json result{{"lines", Json::array()}};
  for (const auto& line : drawn.at("lines")) {
    Json one{{"young_modulus_kPa", line.at("young_modulus_kPa")}};
    one.update(as_xy(line));
    result["lines"].push_back(std::move(one));
  }
  result["range"] = as_xy(drawn.at("support"));
  result["table"] = drawn.at("table");
  result["sentence"] = panel.measured;
  return result;
}

}  // namespace rheocyte
