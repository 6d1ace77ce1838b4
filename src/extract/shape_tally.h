// Takes the shapes of a recording's events, for the verdict on them.
#pragma once
#include <span>
#include <vector>

#include "extract/effective_cell.h"
#include "extract/shape_verdict.h"
#include "infer/modulus_state.h"
#include "infer/shape_excess.h"
#include "numeric/censored_median.h"
#include "shape/outline_tilt.h"

namespace rheocyte {

/// What is known of a block of events, spans of one length; empty where a recording has nothing of the kind. Events
/// outside the gates have no inertia ratio.
struct JudgedEvents {
  std::span<const ShapeExcess> excess;
  std::span<const double> inertia_ratio, area_um2, deformation, mode_3, x_um;
  std::span<const double> modulus_kPa;
  ElongationBlock elongation = {};
  /// c_4 and c_5 beyond those of the elongated cell; empty where no outlines are measured.
  std::span<const double> mode_4_excess = {}, mode_5_excess = {};
  std::span<const double> mode_4 = {}, y_um = {};
  std::span<const OutlineTilt> tilt = {};
  /// Of the moduli from area and deformation, and of elongated cells, which lie there in their table.
  std::span<const ModulusState> states = {}, elongated_states = {};
  std::span<const ElongatedCell> cells = {};
};

/// Medians of the events that are softer than the table: their area as measured, and their place beyond the table of
/// elongated cells; NaN without such events.
struct SofterCells {
  double area_um2 = no_value;
  ElongatedCell elongated = ElongatedCell::Constant(no_value);
};

/// Moduli that are known, and on which side the others lie.
class SidedModuli {
 public:
  void take(ModulusState state, double modulus_kPa);
  JudgedModulus judged() const;

 private:
  std::vector<double> known_;
  CensoredCounts beside_;
};

/// The events that were judged, one value each, as measured.
struct JudgedShapes {
  std::vector<double> inertia_ratio, area_um2, deformation;
};

/// Takes block by block; keeps 104 bytes per event.
class ShapeTally {
 public:
  void take(const JudgedEvents& events);
  /// Of all events taken so far; what the tally does not know (source, direction) is left to the caller.
  ShapeVerdict verdict(double pixel_size_um = no_value) const;
  BesideAxis beside_axis(int direction, const ChannelFlow& flow) const;
  JudgedShapes judged() const;
  SofterCells softer() const;
  /// Of all events with area, deformation and inertia ratio, red cells apart, whether or not a table has such cells.
  const EventFigures& figures() const { return figures_; }
  /// Before the first block: the recording has no inertia ratios.
  void take_without_ratios() { figures_.has_ratios = false; }

 private:
  struct Event {
    float excess, expected, inertia_ratio, odd_fraction, area, deformation, mode_3, x;
    float mode_4, y, sine_mode_2, flank_slope;
  };
  std::vector<double> column(float Event::*member) const;
  std::vector<Event> events_;
  struct Drawn {
    double modulus_kPa;
    float ratio, elongation, axial_tension_Pa, mode_4_excess, mode_5_excess;
  };
  std::vector<double> drawn(float Drawn::*member) const;
  std::vector<Drawn> drawn_;
  std::size_t elongated_ = 0, red_cells_ = 0;
  void take_moduli(const JudgedEvents& events, std::size_t event);
  /// Inside the gates, and whole.
  static bool is_counted(const JudgedEvents& events, std::size_t event);
  SidedModuli by_deformation_, by_elongation_;
  EventFigures figures_;
  std::vector<double> softer_areas_;
  std::vector<ElongatedCell> softer_cells_;
};

}  // namespace rheocyte
