// Populations of cells with bulk, cortex and tensions (docs/theory-populations.md, sec. "Several moduli").
#pragma once
#include <string>

#include "experiment/population_model.h"
#include "extract/event_moduli.h"

namespace rheocyte {

class CombinedPopulations : public PopulationModel {
 public:
  /// UserError if the table is missing, has neither several tensions of the cortex nor elongated cells, or what is
  /// asked needs solids.
  explicit CombinedPopulations(const PopulationOptions& options);

  std::string_view name() const override { return "cortex"; }
  std::string_view elongation_text() const override {
    return "by one axial tension of the liquid in each recording, with a scatter between cells";
  }
  std::string table(const PopulationEvents&) override { return tables_.name(); }
  std::string systematic_errors(std::span<const RecordingReport> recordings) const override;
  void fit(const PopulationEvents& events, RecordingReport& report, const Watch& watch) override;

 private:
  std::optional<Section> wanted_section_;
  double outline_noise_um_;
  ModuliTables tables_;
};

}  // namespace rheocyte
