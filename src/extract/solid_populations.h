// Populations of elastic solids, whose stiffness one measure tells (docs/theory-populations.md, sec. "Model").
#pragma once
#include <string>

#include "extract/population_model.h"
#include "extract/population_sample.h"

namespace rheocyte {

class SolidPopulations : public PopulationModel {
 public:
  /// UserError if tables are missing.
  explicit SolidPopulations(const PopulationOptions& options);

  std::string_view name() const override { return "solid"; }
  std::string_view elongation_text() const override { return "eliminated event by event, with a flat prior"; }
  std::string table(const PopulationEvents& events) override { return maps_.table(events); }
  double table_error(const PopulationEvents& events) override { return maps_.table_error(events); }
  std::string measure_error_text() const override;
  void fit(const PopulationEvents& events, RecordingReport& report) override;

 private:
  PopulationMaps maps_;
  bool no_bins_;
  int threads_;
};

}  // namespace rheocyte
