// The events of a recording whose outlines are fitted: shape, viscosity and gates of each, block by block.
#pragma once
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "events/extract_settings.h"
#include "events/gates.h"
#include "measurement/event_features.h"
#include "measurement/event_outlines.h"
#include "measurement/shape_source.h"

namespace rheocyte {

class OutlinedEvents {
 public:
  /// The recording must outlive it. UserError naming what the recording lacks; `use` of the outlines as in
  /// ShapeSource::check_outlines().
  OutlinedEvents(const Recording& recording, const MeasuringOptions& options, std::string_view use);
  OutlinedEvents(const OutlinedEvents&) = delete;
  OutlinedEvents& operator=(const OutlinedEvents&) = delete;

  const Recording& recording() const { return recording_; }
  const ExtractSettings& settings() const { return settings_; }
  const Gates& gates() const { return gates_; }

  /// Viscosities and gates of events [first, first + count). UserError if the data are damaged.
  void read(std::size_t first, std::size_t count);
  /// Of the events read last (mPa s); NaN where it is unknown.
  std::span<const double> viscosity_mPas() const { return viscosity_mPas_; }
  /// Whether one of the events read last, counted from the first of them, is within the gates.
  bool is_inside(std::size_t i) const { return inside_[i] != 0; }
  /// How many of all events read so far have a temperature for which the viscosity is extrapolated.
  std::size_t outside_temperature() const { return outside_temperature_; }

  /// Shapes are seen as if the cells moved towards greater x, from here on; the sign of their mean asymmetry tells
  /// whether they do (`sign`: of c_3 of such cells). Returns what it tells (direction_of_cells.h). UserError if the
  /// data are damaged.
  int turn_downstream(double sign);
  /// The same where the direction is known already.
  void turn(int direction) { is_mirrored_ = direction < 0; }
  /// Of any event; NaN where there is no cell, or no whole one. UserError if the data are damaged.
  ShapeVector shape(std::size_t event);
  /// Whether the edge of the picture cuts the cell off. UserError if the data are damaged.
  bool is_cut(std::size_t event) { return outlines_.is_cut(event); }

 private:
  const Recording& recording_;
  ExtractSettings settings_;
  EventOutlines outlines_;
  ShapeSource shapes_;
  EventFeatures features_;
  Gates gates_;
  bool is_mirrored_ = false;
  std::vector<double> viscosity_mPas_;
  std::vector<char> inside_;
  std::size_t outside_temperature_ = 0;
};

}  // namespace rheocyte
