// The events of a recording, block by block, as every command reads them: settings, gates, viscosities and shapes of
// each, and what holds of all.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "events/extract_settings.h"
#include "events/gates.h"
#include "events/recording_facts.h"
#include "measurement/event_features.h"
#include "measurement/event_outlines.h"
#include "measurement/shape_source.h"

namespace rheocyte {

enum class OutlineUse { none, if_there, needed };

/// What a command needs of the events.
struct EventNeeds {
  PixelUse pixels = PixelUse::fit;
  OutlineUse outlines = OutlineUse::none;
  std::string_view outlines_for = {};  ///< completes "..., from which", where they are needed
};

class EventReader {
 public:
  /// The recording must outlive it. UserError naming what the recording lacks.
  EventReader(const Recording& recording, const MeasuringOptions& options, const EventNeeds& needs);
  EventReader(const EventReader&) = delete;
  EventReader& operator=(const EventReader&) = delete;

  const Recording& recording() const { return recording_; }
  const ExtractSettings& settings() const { return settings_; }
  const MeasuringConditions& conditions() const { return settings_.conditions; }
  const Gates& gates() const { return gates_; }
  /// Stored areas and deformations, or what stands in for them.
  ShapeSource& stored_shapes() { return shapes_; }
  const ShapeSource& stored_shapes() const { return shapes_; }

  /// Viscosities and gates of events [first, first + count). UserError if the data are damaged.
  void read(std::size_t first, std::size_t count);
  /// Of the events read last (mPa s); NaN where it is unknown.
  std::span<const double> viscosity_mPas() const { return viscosity_mPas_; }
  /// Of one of the events read last; NaN without a viscosity.
  double reynolds(std::size_t i) const { return reynolds_at_1_mPas_ / viscosity_mPas_[i]; }
  /// Whether one of the events read last, counted from the first of them, is within the gates.
  bool is_inside(std::size_t i) const { return inside_[i] != 0; }

  bool has_outlines() const { return outlines_.has_value(); }
  /// Shapes are seen as if the cells moved towards greater x, from here on; the sign of their mean asymmetry determines
  /// whether they do (`sign`: of c_3 of such cells). Returns the direction (direction_of_cells.h). UserError if the
  /// data are damaged.
  int turn_downstream(double sign);
  /// The same where the direction is known already.
  void turn(int direction) { facts_.direction = direction; }
  /// Of any event; NaN where there is no cell, or no whole one. UserError if the data are damaged.
  ShapeVector shape(std::size_t event);
  /// Whether the edge of the picture cuts the cell off. UserError if the data are damaged.
  bool is_cut(std::size_t event) { return outlines_->is_cut(event); }
  /// So many events are left out for that reason.
  void count_cut(std::size_t events) { facts_.cut += events; }

  /// Of the recording and the events read so far.
  const RecordingFacts& facts() const { return facts_; }

 private:
  const Recording& recording_;
  ExtractSettings settings_;
  ShapeSource shapes_;
  EventFeatures features_;
  Gates gates_;
  std::optional<EventOutlines> outlines_;
  RecordingFacts facts_;
  double reynolds_at_1_mPas_;
  std::vector<double> viscosity_mPas_;
  std::vector<char> inside_;
};

}  // namespace rheocyte
