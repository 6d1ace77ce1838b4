// What a computation in time leaves behind: a row for each step, a contour for each output.
#pragma once
#include <string>
#include <tuple>
#include <vector>

#include "case/problem.h"
#include "solve/follow_in_time.h"

namespace rheocyte {

/// Columns of history.csv; physical units.
struct HistoryRow {
  double t_us, deformation, deformation_raw, area_um2, volume_um3, relative_volume_change, velocity_m_per_s,
      flow_rate_ul_per_s, pressure_drop_Pa, step_us, order, newton_iterations, refused_steps, position_um;
};

struct ContourFrame {
  double t_us = 0;
  Eigen::MatrixX2d point_um;  ///< (x, r), front pole first

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& f) {
    return std::tie(f.t_us, f.point_um);
  }
};

struct TimeRecord {
  std::vector<HistoryRow> rows;
  std::vector<ContourFrame> frames;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& r) {
    return std::tie(r.rows, r.frames);
  }
};

HistoryRow history_row(const TimePoint&, const Scales&);
ContourFrame contour_frame(const TimeFrame&, const Scales&);

std::string history_csv(const TimeRecord&);
/// contours.csv: t_us, x_um, r_um; the frames one after another.
std::string contours_csv(const TimeRecord&);

/// channel.csv: x_um, R_um; the wall of a channel that is not straight, finely, from the start of the cell.
std::string channel_csv(const WallTable&, const Scales&);

/// "fields-0003.vtu"
std::string field_file(std::size_t frame);
/// The collection that ParaView opens as one film: all field files with their times.
std::string field_collection(const TimeRecord&, const std::string& folder);

}  // namespace rheocyte
