#include "events/options.h"

#include <fmt/format.h>

#include "case/user_error.h"
#include "events/gates.h"
#include "events/plausibility.h"
#include "events/recording_temperature.h"

namespace rheocyte {

void check_table(const std::string& table, const std::optional<Section>& section) {
  if (!table.empty() && section)
    throw UserError(
        "rheocyte: --table and --section contradict each other, which chooses between the program's own tables; give "
        "one of them.");
}

void check_options(const ExtractOptions& options) {
  check_options(options.measuring);
  check_table(options.table, options.section);
}

void check_options(const MeasuringOptions& options) {
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
