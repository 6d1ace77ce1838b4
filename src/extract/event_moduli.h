// Moduli of bulk and cortex of single events of one recording, by a combined table.
#pragma once
#include "events/events_beyond.h"
#include "events/extract_settings.h"
#include "extract/moduli_summary.h"
#include "extract/moduli_tables.h"
#include "infer/bulk_cortex_fit.h"
#include "infer/combined_population.h"
#include "infer/median_cell.h"
#include "infer/rendered_errors.h"
#include "store/watch.h"

namespace rheocyte {

/// Events of a fitted population beyond the cells of its table: by its sizes those that are left out, by the other
/// sides the shares of the law.
EventsBeyond events_beyond(const CombinedPopulation& population);

/// What the outlines are for, in OutlinedEvents.
inline constexpr std::string_view use_of_outlines = "the shape of each cell is fitted";

class EventModuli {
 public:
  /// Renders the errors of the recording's pixels, which takes about a second. The table must outlive it.
  EventModuli(const ExtractSettings& settings, const ModuliOptions& options, const ModuliTable& table, Section seen_in);

  /// From the shape in pixels (EventOutlines) and the viscosity of the event, with what is known of the axial tension:
  /// nothing, unless it is given or `know_tension` was called.
  ModuliEstimate fit(const ShapeVector& seen, double viscosity_mPas) const;
  /// What one picture adds to the features of a cell of the table.
  ShapeErrors errors_in_picture(const CellCoordinates& cell) const { return pixels_.at(cell); }
  void know_tension(const AxialTension& tension) { tension_ = tension; }

  /// The law of the cells in pixels whose measured ln of the area such a gate passes, with what is known of the
  /// tension: none by so few features that they do not tell it, nor where most cells lie on one side of the table.
  /// `watch` is asked from step to step.
  void tell_law(std::span<const MeasuredCell> cells, const ValueGate& log_area, const Watch& watch,
                AxialSummary& summary) const;
  /// With what is known of the tension.
  MedianCell median_cell(std::span<const MeasuredCell> cells) const;
  /// What all cells of a recording have in common, in parts of each: of the median cell's moduli what is left of their
  /// errors without the noise of single pictures. NaN without such a cell.
  CommonErrors common_errors(std::span<const MeasuredCell> cells) const;
  /// What `fit` would be asked with.
  MeasuredCell measured(const ShapeVector& seen, double viscosity_mPas) const {
    return {seen, {flow_.width_um, flow_.rate_ul_s, viscosity_mPas, flow_.exponent}};
  }

 private:
  /// With the noise of the mean of so many pictures. Nothing without a shape.
  std::optional<SeenCell> seen_cell(const MeasuredCell& measured, double pictures) const;

  Sight sight(const ChannelFlow& flow) const { return {flow, section_, section_error_factor_}; }

  ChannelFlow flow_;
  Section section_;
  double section_error_factor_, pixel_size_um_;
  OutlineNoise outline_noise_;
  RenderedErrors pixels_;
  BulkCortexFit moduli_;
  AxialTension tension_;
};

}  // namespace rheocyte
