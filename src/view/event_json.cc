#include "view/event_json.h"

#include <cmath>

namespace rheocyte {

nlohmann::ordered_json flow_json(const ChannelFlow& flow) {
  nlohmann::ordered_json liquid{{"rate_ul_per_s", flow.rate_ul_s},
                                {"law", flow.exponent == 1 ? "newtonian" : "power-law"}};
  if (flow.exponent == 1) {
    liquid["viscosity_mPas"] = flow.viscosity_mPas;
  } else {
    liquid["consistency_Pa_sn"] = consistency_Pa_sn(flow);
    liquid["exponent"] = flow.exponent;
  }
  return liquid;
}

nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace rheocyte
