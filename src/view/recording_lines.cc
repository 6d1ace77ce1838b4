#include "view/recording_lines.h"

#include <nlohmann/json.hpp>

#include "case/user_error.h"
#include "report/plot_lines.h"
#include "view/line_routes.h"
#include "view/page_words.h"

namespace rheocyte {

nlohmann::ordered_json recording_lines(const Recording& recording, const ExtractOptions& options, const std::string& x,
                                       const std::string& y) {
  PlotOptions plot;
  plot.measuring = options.measuring;
  plot.table = options.table;
  plot.no_pixelation = options.no_pixelation;
  plot.x = x;
  plot.y = y;
  if (!has_usual_axes(plot)) return no_lines_json("There are isoelasticity lines over area_um and deform only.");
  PlotLines lines(plot);
  PlotPanel panel;
  if (is_of_the_reservoir(recording))
    return no_lines_json("was recorded in the reservoir, where no isoelasticity lines exist.");
  try {
    take_conditions(recording, plot, panel);
  } catch (const UserError& missing) {
    return no_lines_json(in_words_of_page(missing.what()));
  }
  return lines_json(lines.for_panel(panel), panel.measured);
}

}  // namespace rheocyte
