// Takes the shapes of a recording's events, for the verdict on them.
#pragma once
#include <span>
#include <vector>

#include "extract/shape_verdict.h"
#include "infer/shape_excess.h"
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
};

/// The events that were judged, one value each, as measured.
struct JudgedShapes {
  std::vector<double> inertia_ratio, area_um2, deformation;
};

/// Takes block by block; keeps 64 bytes per event.
class ShapeTally {
 public:
  void take(const JudgedEvents& events);
  /// Of all events taken so far; what the tally does not know (source, direction) is left to the caller.
  ShapeVerdict verdict() const;
  BesideAxis beside_axis(int direction, const ChannelFlow& flow) const;
  JudgedShapes judged() const;

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
};

}  // namespace rheocyte
