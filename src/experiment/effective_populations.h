// Recordings by the effective modulus of their median cell (docs/theory-extract.md, sec. "The effective modulus").
#pragma once
#include <string>
#include <vector>

#include "experiment/population_model.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {

class EffectivePopulations : public PopulationModel {
 public:
  /// UserError if the tables are missing, or what is asked needs solids.
  explicit EffectivePopulations(const PopulationOptions& options);

  std::string_view name() const override { return "effective"; }
  std::string_view elongation_text() const override { return "by one axial tension of the liquid in each recording"; }
  std::string table(const PopulationEvents& events) override {
    return tables_.proportioned(events.flow().exponent).in_liquid->table().spec().identifier;
  }
  std::string systematic_errors(std::span<const RecordingReport> recordings) const override;
  void fit(const PopulationEvents& events, RecordingReport& report, const Watch& watch) override;
  bool lacks_shape_gates() const override { return true; }
  void compare(const PopulationEvents& without_shape_gates, RecordingReport& report) const override;
  /// Recordings without inertia ratios have the tension of others of their set-up.
  void share(std::span<RecordingReport> recordings) override;

 private:
  EffectiveCell cell_of(const EventFigures& figures, const AxialTension& tension, const RecordingReport& report) const;
  void take_cell(const EventFigures& figures, const AxialTension& tension, RecordingReport& report) const;

  ModulusTables tables_;
  AxialTension given_;
  std::vector<EventFigures> without_ratios_;  ///< of each recording that lacks them, else empty
};

}  // namespace rheocyte
