#include "experiment/model_of_shapes.h"

#include <fmt/format.h>

#include "case/user_error.h"
#include "events/isolated_reading.h"
#include "extract/extraction.h"

namespace rheocyte {
namespace {

bool are_solids_meant(const PopulationOptions& o) {
  return !o.by.empty() || !o.table.empty() || o.shared_spread || o.no_bins || o.outline_noise_um;
}

}  // namespace

std::vector<std::optional<ShapeVerdict>> shapes_of(const std::vector<PopulationCondition>& conditions,
                                                   const PopulationOptions& options, const Watch& watch) {
  ExtractOptions extract;
  extract.measuring = options.measuring;
  extract.axial_tension_Pa = options.axial_tension_Pa;
  const ModulusTables tables(std::string(), options.section);
  const Watch without_progress{.stop = watch.stop, .alive = watch.alive};  // a small part of what follows
  std::vector<std::optional<ShapeVerdict>> shapes;
  for (const auto& condition : conditions)
    for (const auto& recording : condition.recordings) {
      const auto read = [&](const TellProgress& report_progress) {
        return summary_of_recording(recording, extract, tables, report_progress);
      };
      std::optional<ShapeVerdict>& found = shapes.emplace_back();
      try {
        found = read_isolated(recording, options.measuring, without_progress, read).shapes;
      } catch (const UserError&) {  // what is wrong with the recording is named where its population is fitted
      }
    }
  return shapes;
}

ChosenModel model_of_shapes(const PopulationOptions& options, const std::vector<std::optional<ShapeVerdict>>& shapes) {
  if (!options.model.empty()) return {options.model, ""};
  if (options.axial_tension_Pa) return {"effective", ""};
  if (are_solids_meant(options)) return {"solid", ""};
  int effective = 0, known = 0;
  for (const auto& verdict : shapes) {
    if (!verdict) continue;
    effective += verdict->has_effective_modulus() ? 1 : 0;
    known += verdict->has_effective_modulus() || verdict->fit() != ShapeVerdict::Fit::unknown ? 1 : 0;
  }
  if (known == 0) return {"solid", ""};
  if (2 * effective >= known)
    return {"effective",
            fmt::format("the cells of {} of {} recordings are longer than the flow makes solids", effective, known)};
  return {"solid", fmt::format("the cells of {} of {} recordings have the shapes of solids", known - effective, known)};
}

}  // namespace rheocyte
