#include "experiment/model_of_shapes.h"

#include <fmt/format.h>

#include "events/isolated_reading.h"
#include "extract/extraction.h"

namespace rheocyte {
namespace {

bool are_solids_meant(const PopulationOptions& o) {
  return !o.by.empty() || !o.table.empty() || o.shared_spread || o.no_bins || o.outline_noise_um;
}

/// Of the recordings whose shapes are known.
struct Shapes {
  int effective = 0, known = 0;
};

Shapes shapes_of(const std::vector<PopulationCondition>& conditions, const PopulationOptions& options,
                 const Watch& watch) {
  ExtractOptions extract;
  extract.measuring = options.measuring;
  extract.axial_tension_Pa = options.axial_tension_Pa;
  const ModulusTables tables(std::string(), options.section);
  Shapes shapes;
  for (const auto& condition : conditions)
    for (const auto& recording : condition.recordings) {
      const auto read = [&](const TellProgress& report_progress) {
        return summary_of_recording(recording, extract, tables, report_progress);
      };
      const ShapeVerdict verdict = read_isolated(recording, options.measuring, watch, read).shapes;
      shapes.effective += verdict.has_effective_modulus() ? 1 : 0;
      shapes.known += verdict.has_effective_modulus() || verdict.fit() != ShapeVerdict::Fit::unknown ? 1 : 0;
    }
  return shapes;
}

}  // namespace

ChosenModel model_of_shapes(const std::vector<PopulationCondition>& conditions, const PopulationOptions& options,
                            const Watch& watch) {
  if (!options.model.empty()) return {options.model, ""};
  if (options.axial_tension_Pa) return {"effective", ""};
  if (are_solids_meant(options)) return {"solid", ""};
  // It has no progress of its own: reading is a small part of what follows.
  const Shapes shapes = shapes_of(conditions, options, {.stop = watch.stop, .alive = watch.alive});
  if (shapes.known == 0) return {"solid", ""};
  if (2 * shapes.effective >= shapes.known)
    return {"effective", fmt::format("the cells of {} of {} recordings are longer than the flow makes solids",
                                     shapes.effective, shapes.known)};
  return {"solid", fmt::format("the cells of {} of {} recordings have the shapes of solids",
                               shapes.known - shapes.effective, shapes.known)};
}

}  // namespace rheocyte
