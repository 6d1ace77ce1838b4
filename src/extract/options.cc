#include "extract/options.h"

#include <fmt/format.h>

#include <cmath>

#include "case/user_error.h"
#include "extract/gates.h"
#include "extract/plausibility.h"
#include "extract/recording_temperature.h"

namespace rheocyte {

void check_measuring_options(const MeasuringOptions& options) {
  if (!(options.patience_s > 0 && std::isfinite(options.patience_s)))
    throw UserError("rheocyte: --patience must be a positive number.");
  static_cast<void>(Gates(options.gates));
  check_temperatures(options);
  if (!options.viscosity_mPas) return;
  check_viscosity(*options.viscosity_mPas, "rheocyte: --viscosity-mPas");
  const char* const other = options.medium                            ? "--medium"
                            : options.viscosity_model                 ? "--viscosity-model"
                            : !options.temperature.empty()            ? "--temperature"
                            : !options.temperature_if_missing.empty() ? "--temperature-if-missing"
                                                                      : nullptr;
  if (other)
    throw UserError(fmt::format("rheocyte: --viscosity-mPas and {} contradict each other; give one of them.", other));
}

}  // namespace rheocyte
