#include "extract/options.h"

#include <fmt/format.h>

#include <cmath>

#include "case/user_error.h"

namespace rheocyte {

namespace {

void check_positive(const std::optional<double>& value, const char* option) {
  if (value && !(*value > 0 && std::isfinite(*value)))
    throw UserError(fmt::format("rheocyte: {} must be a positive number.", option));
}

}  // namespace

void check_measuring_options(const MeasuringOptions& options) {
  check_positive(options.channel_width_um, "--channel-width");
  check_positive(options.flow_rate_ul_s, "--flow-rate");
  check_positive(options.pixel_size_um, "--pixel-size");
  check_positive(options.viscosity_mPas, "--viscosity");
  check_positive(options.patience_s, "--patience");
  static_cast<void>(Gates(options.gates));
  if (!options.viscosity_mPas) return;
  const char* const other = options.medium                 ? "--medium"
                            : options.viscosity_model      ? "--viscosity-model"
                            : !options.temperature.empty() ? "--temperature"
                                                           : nullptr;
  if (other)
    throw UserError(fmt::format("rheocyte: --viscosity and {} contradict each other; give one of them.", other));
}

}  // namespace rheocyte
