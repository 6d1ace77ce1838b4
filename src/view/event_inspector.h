// All that is known of one event: its features, its modulus or the reason why there is none, its outline and that of
// the model's cell.
#pragma once
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "extract/modulus_tables.h"
#include "extract/options.h"
#include "measurement/recording.h"

namespace rheocyte {

struct InspectedRecording {
  const Recording& recording;
  const Recording* companion;  ///< what has been computed from it; null: nothing
};

/// {"event", "features", "young_modulus_kPa", "standard_error_kPa", "state", "sentence", "shape_excess",
/// "young_modulus_asymmetry_kPa", "viscosity_mPas", "pixel_um", "image_size", "outline", "model", "case", ...}, with
/// the numbers that `rheocyte extract` with these options gives for this event; what is not known is null. Lengths in
/// um in the frame of the picture: x along its rows, y down, from its corner. UserError: no such event, damaged data.
nlohmann::ordered_json inspect_event(const InspectedRecording& file, const ExtractOptions& options,
                                     const ModulusTables& tables, std::size_t event);

/// A picture of one event, "image" or "mask", as PNG. UserError if there is none.
std::string picture_of_event(const Recording& recording, const std::string& feature, std::size_t event);

}  // namespace rheocyte
