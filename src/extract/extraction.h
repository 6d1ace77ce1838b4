// The moduli of the events of one recording: settings in, events and their summary out. Nothing is written.
#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "events/event_pass.h"
#include "events/event_reader.h"
#include "events/options.h"
#include "extract/event_block.h"
#include "extract/event_shapes.h"
#include "extract/extract_summary.h"
#include "extract/modulus_values.h"
#include "extract/recommendation.h"
#include "extract/shape_tally.h"
#include "extract/table_comparison.h"
#include "measurement/recording.h"
#include "shelf/modulus_tables.h"
#include "store/progress.h"

namespace rheocyte {

/// One recording on its way through the blocks; memory does not grow with it but for 100 bytes per event.
class Extraction {
 public:
  /// The three must outlive the object. UserError naming what the recording lacks, and the option that gives it.
  Extraction(const Recording& recording, const ExtractOptions& options, const ModulusTables& tables);

  const ModulusMap& table() const { return table_; }
  const ExtractSettings& settings() const { return events_.settings(); }
  const MeasuringConditions& conditions() const { return events_.conditions(); }
  const ShapeSource& shapes() const { return events_.stored_shapes(); }
  const EventShapes& event_shapes() const { return event_shapes_; }
  /// What there is of each event.
  EventKnowledge knowledge() const {
    return {table_.is_rheocyte_table(), event_shapes_.is_known(), event_shapes_.has_asymmetry(),
            event_shapes_.elongated_by(), effective_map_ != nullptr};
  }
  /// From now on events have an effective modulus, too: that of a cell under the axial tension of this one. False if
  /// the cell has none, or the table of such cells has none under this tension; then nothing changes.
  bool take_tension(const EffectiveCell& cell);
  /// The modulus that is recommended if the gates on the shape are lifted; NaN without one.
  void take_without_shape_gates(double kPa) { without_shape_gates_kPa_ = kPa; }
  /// From now on blocks hold the features of the outlines, too, where contours or masks are read.
  void measure_outlines() { event_shapes_.measure_outlines(settings().pixel_size_um); }
  /// The number of events that are best computed at once.
  std::size_t block() const;
  /// Of events [first, first + count), until the next call. All events in turn, so that the summary is that of all.
  /// UserError if the data are damaged.
  EventBlock compute(std::size_t first, std::size_t count);
  /// Of the events computed so far.
  ExtractSummary summary();
  /// With what the moduli were computed, one line each, the last one with the hash of all that decides them.
  std::vector<std::string> lines() const;

 private:
  struct Columns {
    std::vector<double> area, deformation;
    ModulusValues moduli, effective;  ///< the latter of cells under an axial tension
    ShapeColumns shapes;
    void resize(std::size_t count);
  };

  std::string settings_hash() const;
  std::string beyond_the_square() const;
  void add_soft_ends(ExtractSummary& summary) const;
  void add_effective_cell(ExtractSummary& summary) const;
  std::string gates_on_shapes(const ShapeVerdict& shapes) const;
  void add_effective_events(ExtractSummary& summary) const;
  void collect();
  void compute_effective(const MeasuredEvents& events);
  void add_inertia_error(const EstimatedModuli& moduli);
  static void mark_unresolved(const EstimatedModuli& moduli);
  void apply_gates();
  void leave_out_cut();
  /// Event `i` of the block has no modulus, for this reason.
  void leave_out(std::size_t i, ModulusState why);
  void take_modulus(std::size_t i);
  void compute_shapes(std::size_t first, const MeasuredEvents& events);

  const ModulusTables& tables_;
  EventReader events_;
  const ModulusMap& table_;
  TableComparison comparison_;
  AxialTension tension_;  ///< what is known of it before
  bool are_square_;       ///< the tables, of which those of the tube reach farther
  EventShapes event_shapes_;
  ShapeTally shape_tally_;
  Columns columns_;
  ExtractSummary summary_;
  std::unique_ptr<const ModulusMap> effective_map_;  ///< null: events have no effective modulus
  EffectiveCell effective_cell_;                     ///< under whose tension they have one
  SidedModuli effective_moduli_;
  double without_shape_gates_kPa_ = no_value;
  std::vector<double> moduli_;
  std::vector<float> standard_errors_;
  double viscosity_sum_ = 0;
  std::size_t viscosities_ = 0;
};

/// Of all events of a recording, whose medians alone are wanted. UserError.
ExtractSummary summary_of_recording(const std::filesystem::path& recording, const ExtractOptions& options,
                                    const ModulusTables& tables, const TellProgress& on_progress);

/// The modulus that is recommended if the gates on the shape are lifted; NaN without one, or without such gates.
double without_shape_gates_kPa(const Recording& recording, const ExtractOptions& options, const ModulusTables& tables,
                               EventPass& events);

/// All events of a recording once, by `pass`, which computes all blocks of an extraction and returns its summary. Where
/// the effective modulus is recommended once more: then events have one under the axial tension that the first pass
/// found. Where gates limit the shapes they are lifted first, in a pass of its own.
template <class Pass>
ExtractSummary extract_in_passes(const Recording& recording, const ExtractOptions& options, const ModulusTables& tables,
                                 EventPass& events, const Pass& pass) {
  const double without_gates = without_shape_gates_kPa(recording, options, tables, events);
  Extraction first(recording, options, tables);
  first.take_without_shape_gates(without_gates);
  ExtractSummary summary = pass(first);
  if (recommendation(summary.shapes).way != RecommendedWay::effective) return summary;
  Extraction second(recording, options, tables);
  second.take_without_shape_gates(without_gates);
  return second.take_tension(summary.shapes.effective) ? pass(second) : summary;
}

}  // namespace rheocyte
