// The pictures of a recording's cells along the channel behind a contraction: read, freed of pixels, brought to the
// channel of a dynamic table, and linked to cells (docs/theory-extract.md, sec. "Time courses").
#pragma once
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "case/channel_flow.h"
#include "events/options.h"
#include "events/recording_facts.h"
#include "infer/square_course.h"
#include "infer/time_course.h"
#include "store/progress.h"

namespace rheocyte {

/// One event with all that is needed; in the recording's own units and direction.
struct CourseEvent {
  double event = 0;  ///< from 1 on
  double x_um = 0, y_um = 0, time_s = 0, area_um2 = 0, mode_2 = 0, mode_3 = 0, deviation = 0;
};

/// Of one recording.
struct CourseEvents : RecordingFacts {
  std::vector<CourseEvent> events;
  ChannelFlow flow;  ///< with the median viscosity of its events
  bool has_time = false;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tuple_cat(RecordingFacts::fields(s), std::tie(s.events, s.flow, s.has_time));
  }
};

/// UserError for what is wrong with the recording, which must have pos_x and contours or masks.
CourseEvents read_course_events(const std::filesystem::path& recording, const MeasuringOptions& options,
                                const TellProgress& report_progress);

/// A cell, or one that was not seen again.
struct CourseCell {
  CellImages images;           ///< in channel and liquid of the table
  std::vector<double> events;  ///< their numbers
};

struct CourseCells {
  std::vector<CourseCell> cells;
  std::size_t outside_places = 0, outside_areas = 0;  ///< events that the table does not have
};

/// The same in the channel of the table. `contraction_um`: pos_x of the end of the contraction, from which the cells
/// move away. `stationary`: brings pictures of a square channel to channel and liquid of the table; null: these are
/// those of the recording. UserError naming the recording if its channel has another width.
CourseCells course_cells(const CourseEvents& events, const std::string& name, double contraction_um,
                         const DynamicTable& table, const SquareCourse* stationary);

/// UserError: why these cells do not tell Young's modulus and viscosity.
void check_places_seen(const std::vector<CourseCell>& cells);

/// How far a cell's own pictures lie apart (um).
double seen_um(const CellImages& images);
/// Cells that are seen so far apart, or populations.
inline constexpr double min_seen_um = 20;
inline constexpr std::size_t min_population = 50;

}  // namespace rheocyte
