// Populations of elastic solids, whose stiffness one measure gives (docs/theory-populations.md, sec. "Model").
#pragma once
#include <string>

#include "experiment/population_model.h"
#include "experiment/population_sample.h"

namespace rheocyte {

/// The numbers of the fitted cells of a recording.
void tell_quantities(RecordingReport& r);

class SolidPopulations : public PopulationModel {
 public:
  /// UserError if tables are missing.
  explicit SolidPopulations(const PopulationOptions& options);

  std::string_view name() const override { return "solid"; }
  std::string_view elongation_text() const override { return "eliminated event by event, with a flat prior"; }
  std::string table(const PopulationEvents& events) override { return maps_.table(events); }
  std::string systematic_errors(std::span<const RecordingReport> recordings) const override;
  void fit(const PopulationEvents& events, RecordingReport& report, const Watch& watch) override;

 private:
  PopulationMaps maps_;
  double table_error_ = 0;  ///< greatest of the recordings so far
  bool no_bins_;
  int threads_;
};

}  // namespace rheocyte
