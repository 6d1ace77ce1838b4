#include "extract/event_moduli.h"

#include <fmt/format.h>

#include "case/user_error.h"
#include "measurement/metadata.h"
#include "table/table_metadata.h"

namespace rheocyte {

ModuliTable::ModuliTable(const ModuliOptions& options)
    : content(read_combined_table(options.table)),
      between(content),
      simulated(channel_flow_of(content.spec.base)),
      section(options.section.value_or(Section::square), content.spec.base) {
  if (options.fit_tension && between.tension_ratios().size() < 2)
    throw UserError(
        fmt::format("rheocyte: --fit-tension needs a table with several tensions (table.tension_ratio); {} has one.",
                    content.spec.identifier));
}

Section ModuliTable::section_of(const Recording& recording, std::optional<Section> wanted) const {
  if (wanted) return *wanted;
  const Case& base = content.spec.base;
  const auto cells = recording.metadata().text(made_of_key);
  const bool are_of_this_table = cells && *cells == cells_in_words(model_text(base), base.channel.section);
  return are_of_this_table ? base.channel.section : Section::square;
}

EventModuli::EventModuli(const ExtractSettings& settings, const ModuliOptions& options, const ModuliTable& table,
                         Section seen_in)
    : flow_(settings.conditions.flow),
      pixels_(table.between, settings.pixel_size_um * table.simulated.width_um / flow_.width_um),
      moduli_(table.between, table.simulated,
              {options.only_figure ? features_of_figure() : features_of_contour(), options.fit_tension,
               table.between.tension_ratios().front()}) {
  const ModulusMap* const square = seen_in == Section::square ? table.section.table(flow_.exponent) : nullptr;
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
