// What a computation in time leaves behind: a row for each step, a contour for each output.
#pragma once
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "case/physical_scales.h"
#include "numeric/no_value.h"
#include "result/field.h"
#include "solve/transient.h"

namespace rheocyte {

struct Problem;

/// A row of history.csv; physical units.
struct HistoryRow {
  double t_us, step_us, order, newton_iterations, refused_steps, position_um;
  std::array<double, history_measures.size()> measures;  ///< in the order of history_measures
  /// By its name, which must be one of history_measures.
  double measure(std::string_view name) const;
};

/// A row of outputs.csv, and a contour.
struct ContourFrame {
  double t_us = 0, position_um = 0;
  Eigen::MatrixX2d point_um;                                  ///< (x, r), front pole first
  std::array<double, history_measures.size()> measures = {};  ///< in the order of history_measures
  Eigen::MatrixX2d across_um = {};                            ///< the same seen along the width; empty: looks alike
  Eigen::MatrixX2d offset_um = {};                            ///< outline in the plane of the offset; empty: centred

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& f) {
    return std::tie(f.t_us, f.position_um, f.point_um, f.measures, f.across_um, f.offset_um);
  }
};

/// Why a run in time has ended.
enum class TimeEnd { time, place, settled, failure };

struct TimeRecord {
  std::vector<HistoryRow> rows;
  std::vector<ContourFrame> frames;
  TimeEnd end = TimeEnd::failure;
  /// How the runs to compare with ended; not_started: there was none.
  Status comparison = Status::not_started;
  TimeWay way;                                       ///< rows and frames as they were computed
  std::vector<HistoryRow> row_errors, frame_errors;  ///< of these; empty: not known
  /// Of the same cell, at the end of the run; NaN if there is none, or none to compare with.
  double stationary_deformation = no_value;
  double stationary_error = no_value;  ///< of that deformation

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& r) {
    return std::tie(r.rows, r.frames, r.way);
  }
};

/// Places in history_measures of those that are columns: some are reported of ducts alone.
std::vector<std::size_t> known_measures(const std::vector<HistoryRow>&);

/// The row of the least meridional tension of the surface; there must be a row.
const HistoryRow& min_tension(const TimeRecord&);

/// Of a point, or of the errors of one.
HistoryRow history_row(const TimePoint&, const Scales&);
ContourFrame contour_frame(const TimeFrame&, const Scales&);

/// These add a step, an output, and the errors of all of them.
void add_step(const TimePoint&, const Scales&, TimeRecord&);
void add_frame(const TimeFrame&, const Scales&, TimeRecord&);
void add_errors(const TimeWay& errors, const Scales&, TimeRecord&);

/// Time, measures of the state, and these columns.
std::string history_csv(const TimeRecord&);
std::span<const Field<HistoryRow>> history_fields();

/// The same numbers at the outputs: time, place, measures of the state.
std::string outputs_csv(const TimeRecord&);

/// Of history.csv and outputs.csv, line by line: the errors of times, places and measures, absolute; empty where they
/// are not known.
std::string history_errors_csv(const TimeRecord&);
std::string outputs_errors_csv(const TimeRecord&);

/// What result.json contains of the way, under "time"; there must be a row.
std::span<const Field<TimeRecord, nlohmann::ordered_json>> time_fields();

/// contours.csv: t_us, x_um, r_um; the frames one after another.
std::string contours_csv(const TimeRecord&);
/// contours_across.csv: the same along the width; empty where the channel looks alike from there.
std::string contours_across_csv(const TimeRecord&);
/// contours_offset.csv: the outlines in the plane of the offset; empty on the axis.
std::string contours_offset_csv(const TimeRecord&);

/// The wall of a channel that is not straight, its distance from the axis at samples + 1 places from start to end (in
/// R); of a duct half its width.
struct WallLine {
  std::vector<double> x_um, distance_um;
};
WallLine wall_line(const Problem&, const Scales&, double start, double end, int samples);

/// channel.csv: x_um, R_um; the wall of a channel that is not straight, finely, from the start of the cell. In a duct
/// half its width.
std::string channel_csv(const Problem&, const Scales&);

/// "fields-0003.vtu"
std::string field_file(std::size_t frame);
/// The collection that ParaView opens as one film: all field files with their times.
std::string field_collection(const TimeRecord&, const std::string& folder);

}  // namespace rheocyte
