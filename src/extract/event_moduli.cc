#include "extract/event_moduli.h"

#include <fmt/format.h>

#include "case/user_error.h"

namespace rheocyte {

ModuliTable::ModuliTable(const ModuliOptions& options)
    : content(read_combined_table(options.table)),
      between(content),
      simulated(channel_flow_of(content.spec.base)),
      section(options.section, content.spec.base) {
  if (options.fit_tension && between.tension_ratios().size() < 2)
    throw UserError(
        fmt::format("rheocyte: --fit-tension needs a table with several tensions (table.tension_ratio); {} has one.",
                    content.spec.identifier));
}

EventModuli::EventModuli(const ExtractSettings& settings, const ModuliOptions& options, const ModuliTable& table)
    : flow_(settings.conditions.flow),
      pixels_(table.between, settings.pixel_size_um * table.simulated.width_um / flow_.width_um),
      moduli_(table.between, table.simulated,
              {options.only_figure ? features_of_figure() : features_of_contour(), options.fit_tension,
               table.between.tension_ratios().front()}) {
  const ModulusMap* const square = table.section.table(flow_.exponent);
  if (!square || table.content.spec.cortex_shares.front() > 0) return;
  square_.emplace(table.between, table.simulated, *square);
  square_table_ = square->origin().identifier;
}

ModuliEstimate EventModuli::fit(const ShapeVector& seen, double viscosity_mPas) const {
  ChannelFlow flow = flow_;
  flow.viscosity_mPas = viscosity_mPas;
  return fit_pixels(moduli_, pixels_, seen, flow, square_ ? &*square_ : nullptr);
}

}  // namespace rheocyte
