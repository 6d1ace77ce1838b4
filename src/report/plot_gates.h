// The gates that can be drawn in a picture of events: those of the features on its axes.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "report/plot_options.h"

namespace rheocyte {

/// {"x": [min, max], "y": [min, max], "polygons": [{"x": [...], "y": [...]}, ...]}, an end without a limit null.
/// UserError as Gates.
nlohmann::ordered_json gates_in_picture(const PlotOptions& options);

}  // namespace rheocyte
