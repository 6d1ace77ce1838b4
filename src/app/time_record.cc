#include "app/time_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "case/scales.h"
#include "laws/wall_profile.h"

namespace rheocyte {

namespace {

constexpr double um_per_m = 1e6, us_per_s = 1e6;

}  // namespace

HistoryRow history_row(const TimePoint& point, const Scales& scales) {
  const double um = scales.length_m * um_per_m, us = scales.time_s() * us_per_s;
  const ShapeMeasures& shape = point.shape;
  return {us * point.time,
          shape.deformation,
          shape.deformation_raw,
          um * um * shape.area,
          um * um * um * shape.volume,
          point.relative_volume_change,
          scales.velocity_m_per_s * point.cell_velocity,
          unit_rate_ul_per_s(scales) * point.flow_rate,
          scales.stress_Pa * point.pressure_drop,
          us * point.step,
          double(point.order),
          double(point.newton_iterations),
          double(point.refused_steps),
          um * point.position};
}

ContourFrame contour_frame(const TimeFrame& frame, const Scales& scales) {
  Eigen::Index rows = 1;
  for (const CurvePiece& piece : frame.contour.pieces) rows += piece.rows() - 1;
  ContourFrame result{scales.time_s() * us_per_s * frame.time, Eigen::MatrixX2d(rows, 2)};
  Eigen::Index row = 0;
  for (const CurvePiece& piece : frame.contour.pieces) {  // a piece begins where the one before ends
    result.point_um.middleRows(row, piece.rows()) = scales.length_m * um_per_m * piece;
    row += piece.rows() - 1;
  }
  return result;
}

std::string history_csv(const TimeRecord& record) {
  std::string text =
      "t_us,deformation,deformation_raw,area_um2,volume_um3,relative_volume_change,velocity_m_per_s,"
      "flow_rate_ul_per_s,pressure_drop_Pa,step_us,order,newton_iterations,refused_steps,position_um\n";
  for (const HistoryRow& r : record.rows)
    fmt::format_to(std::back_inserter(text),
                   "{:.12g},{:.10g},{:.10g},{:.10g},{:.12g},{:.3e},{:.8g},{:.10g},{:.8g},{:.6g},{},{},{},{:.10g}\n",
                   r.t_us, r.deformation, r.deformation_raw, r.area_um2, r.volume_um3, r.relative_volume_change,
                   r.velocity_m_per_s, r.flow_rate_ul_per_s, r.pressure_drop_Pa, r.step_us, r.order,
                   r.newton_iterations, r.refused_steps, r.position_um);
  return text;
}

std::string contours_csv(const TimeRecord& record) {
  std::string text = "t_us,x_um,r_um\n";
  for (const ContourFrame& frame : record.frames)
    for (Eigen::Index i = 0; i < frame.point_um.rows(); ++i)
      fmt::format_to(std::back_inserter(text), "{:.10g},{:.8g},{:.8g}\n", frame.t_us, frame.point_um(i, 0),
                     std::max(frame.point_um(i, 1), 0.0));
  return text;
}

std::string channel_csv(const WallTable& table, const Scales& scales) {
  constexpr int samples = 500;
  constexpr double beyond = 4;  // tube radii
  const WallProfile wall(table);
  const double um = scales.length_m * um_per_m, start = table.x.front() - beyond, end = table.x.back() + beyond;
  std::string text = "x_um,R_um\n";
  for (int i = 0; i <= samples; ++i) {
    const double x = start + (end - start) * i / samples;
    fmt::format_to(std::back_inserter(text), "{:.8g},{:.8g}\n", um * x, um * wall.radius(x));
  }
  return text;
}

std::string field_file(std::size_t frame) { return fmt::format("fields-{:04}.vtu", frame); }

std::string field_collection(const TimeRecord& record, const std::string& folder) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (std::size_t i = 0; i < record.frames.size(); ++i)
    text += fmt::format("    <DataSet timestep=\"{:.10g}\" file=\"{}/{}\"/>\n", record.frames[i].t_us, folder,
                        field_file(i));
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace rheocyte
