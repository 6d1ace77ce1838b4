#include "view/line_routes.h"

#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "case/json_guard.h"
#include "report/plot_lines.h"
#include "serve/router.h"
#include "view/case_from_json.h"
#include "view/view_part.h"

namespace rheocyte {

namespace {

using Json = nlohmann::ordered_json;

Json as_xy(const nlohmann::json& points) { return {{"x", points.at("area_um2")}, {"y", points.at("deformation")}}; }

/// GET /api/lines?case=JSON: lines of the channel and the flow of a case, without pixels, of the tables that come with
/// the program, which are read once.
class PlaneLines {
 public:
  Json of(const Case& c) {
    if (!c.flow.rate_ul_per_s || c.flow.law == LiquidLaw::carreau)
      return no_lines_json("Isoelasticity lines are known for a given flow rate of a Newtonian or power-law liquid.");
    const std::scoped_lock lock(mutex_);
    if (!lines_) lines_.emplace(options_);
    if (lines_->wanted() == LinesWanted::no) return no_lines_json("No table of the program was found.");
    PlotPanel panel;
    panel.conditions.flow = channel_flow_of(c);
    return lines_json(lines_->for_panel(panel), "Cells without a cortex, neo-Hookean.");
  }

 private:
  std::mutex mutex_;
  PlotOptions options_;
  std::optional<PlotLines> lines_;
};

}  // namespace

Json lines_json(const nlohmann::json& drawn, const std::string& sentence) {
  Json result{{"lines", Json::array()}};
  for (const auto& line : drawn.at("lines")) {
    Json one{{"young_modulus_kPa", line.at("young_modulus_kPa")}};
    one.update(as_xy(line));
    result["lines"].push_back(std::move(one));
  }
  result["range"] = drawn.contains("support") ? as_xy(drawn.at("support")) : Json(nullptr);
  result["table"] = drawn.at("table");
  result["sentence"] = sentence;
  return result;
}

Json no_lines_json(const std::string& sentence) {
  return {{"lines", Json::array()}, {"range", nullptr}, {"table", nullptr}, {"sentence", sentence}};
}

namespace {

void add_line_routes(const ViewContext& view) {
  view.router.add("GET", "/api/lines", [lines = std::make_shared<PlaneLines>()](const Request& request) {
    const Json tree = parse_sound_json(request.asked("case"));
    if (!tree.is_object()) throw Refused(400, "input", "The query needs the case as JSON: case={...}.");
    return json_answer(lines->of(case_from_json(tree)));
  });
}

}  // namespace

extern const ViewPart line_routes{add_line_routes};

}  // namespace rheocyte
