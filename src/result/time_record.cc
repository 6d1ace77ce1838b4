#include "result/time_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/scales.h"
#include "laws/wall_profile.h"

namespace rheocyte {

using Json = nlohmann::ordered_json;

namespace {

std::array<double, history_measures.size()> in_history(const StateNumbers& state, const Scales& scales) {
  std::array<double, history_measures.size()> measures;
  std::ranges::transform(history_measures, measures.begin(),
                         [&](const StateMeasure& measure) { return measure.physical(state, scales); });
  return measures;
}

std::string_view name(TimeEnd end) {
  constexpr std::string_view names[] = {"time", "place", "settled", "failure"};
  return names[std::size_t(end)];
}

using Rows = std::vector<HistoryRow>;

const HistoryRow& slackest(const Rows& rows) {
  return *std::ranges::min_element(rows, {},
                                   [](const HistoryRow& row) { return row.measure("least_tension_mN_per_m"); });
}

double place_reached(const Rows& rows) { return rows.back().position_um; }
double least_tension(const Rows& rows) { return slackest(rows).measure("least_tension_mN_per_m"); }
double volume_change(const HistoryRow& row) { return std::abs(row.measure("relative_volume_change")); }
const HistoryRow& most_changed(const Rows& rows) { return *std::ranges::max_element(rows, {}, volume_change); }

/// Of an extreme of the way the error is that of the step where it is.
Json errors_of_way(const TimeRecord& record) {
  const auto error_at = [&](const HistoryRow& row, const auto& error) {
    return record.row_errors.empty() ? no_value : error(record.row_errors[std::size_t(&row - record.rows.data())]);
  };
  const auto of_measure = [](std::string_view name) {
    return [name](const HistoryRow& errors) { return errors.measure(name); };
  };
  const HistoryRow& last = record.rows.back();
  return {
      {"t_us", error_at(last, [](const HistoryRow& errors) { return errors.t_us; })},
      {"position_um", error_at(last, [](const HistoryRow& errors) { return errors.position_um; })},
      {"least_tension_mN_per_m", error_at(slackest(record.rows), of_measure("least_tension_mN_per_m"))},
      {"greatest_relative_volume_change", error_at(most_changed(record.rows), of_measure("relative_volume_change"))},
      {"stationary_deformation", record.stationary_error}};
}

}  // namespace

std::span<const Field<HistoryRow>> history_fields() {
  static constexpr Field<HistoryRow> fields[] = {
      {"step_us", "step in time that led here", [](const HistoryRow& r) { return r.step_us; }},
      {"order", "order of that step", [](const HistoryRow& r) { return r.order; }},
      {"newton_iterations", "Newton iterations of that step", [](const HistoryRow& r) { return r.newton_iterations; }},
      {"refused_steps", "larger steps that were tried before it", [](const HistoryRow& r) { return r.refused_steps; }},
      {"position_um", "of the cell along the channel, from its start",
       [](const HistoryRow& r) { return r.position_um; }},
      {"velocity_m_per_s", "former name of cell_velocity_m_per_s; removed in the next version",
       [](const HistoryRow& r) { return r.measure("cell_velocity_m_per_s"); }}};
  return fields;
}

const HistoryRow& min_tension(const TimeRecord& record) { return slackest(record.rows); }

std::span<const Field<TimeRecord, Json>> time_fields() {
  static constexpr Field<TimeRecord, Json> fields[] = {
      {"t_us", "time that was reached", [](const TimeRecord& r) -> Json { return r.rows.back().t_us; }},
      {"position_um", "place that was reached, from the start of the cell",
       [](const TimeRecord& r) -> Json { return place_reached(r.rows); }},
      {"ended_by", "time, place: as given in the case; settled: nothing changed any more; failure: see status",
       [](const TimeRecord& r) -> Json { return name(r.end); }},
      {"comparison",
       "how the same run with other steps and on another mesh ended, which gives the errors: converged, or why not; "
       "null: there was none",
       [](const TimeRecord& r) -> Json {
         return r.comparison == Status::not_started ? Json() : Json(rheocyte::name(r.comparison));
       }},
      {"least_tension_mN_per_m",
       "minimum meridional tension of the surface on the way; a shell wrinkles where it is negative",
       [](const TimeRecord& r) -> Json { return least_tension(r.rows); }},
      {"steps", "steps in time", [](const TimeRecord& r) -> Json { return r.rows.size() - 1; }},
      {"frames", "contours and files of fields", [](const TimeRecord& r) -> Json { return r.frames.size(); }},
      {"greatest_relative_volume_change", "maximum magnitude on the way",
       [](const TimeRecord& r) -> Json { return volume_change(most_changed(r.rows)); }},
      {"stationary_deformation",
       "of the same cell, with a mesh chosen for its accuracy; null if there is no such shape, or a contraction",
       [](const TimeRecord& r) -> Json { return r.stationary_deformation; }},
      {"errors",
       "estimated errors of numbers of the way, absolute, each under the name and in the unit of its number: from the "
       "same run with other steps and on another mesh, that of the stationary deformation from its own meshes; null "
       "where there is no such run. A run that ends at a time has an error of its place, one that ends at a place of "
       "its "
       "time",
       errors_of_way}};
  return fields;
}

double HistoryRow::measure(std::string_view name) const {
  const auto place = std::ranges::find(history_measures, name, &StateMeasure::name) - history_measures.begin();
  return measures.at(std::size_t(place));
}

HistoryRow history_row(const TimePoint& point, const Scales& scales) {
  const double um = scales.length_um(), us = scales.time_us();
  return {us * point.time,
          us * point.step,
          double(point.order),
          double(point.newton_iterations),
          double(point.refused_steps),
          um * point.position,
          in_history(point.state, scales)};
}

void add_step(const TimePoint& point, const Scales& scales, TimeRecord& record) {
  record.rows.push_back(history_row(point, scales));
  record.way.steps.push_back(point);
}

void add_frame(const TimeFrame& frame, const Scales& scales, TimeRecord& record) {
  record.frames.push_back(contour_frame(frame, scales));
  record.way.outputs.push_back({.time = frame.time, .position = frame.position, .state = frame.state});
}

void add_errors(const TimeWay& errors, const Scales& scales, TimeRecord& record) {
  for (const TimePoint& point : errors.steps) record.row_errors.push_back(history_row(point, scales));
  for (const TimePoint& point : errors.outputs) record.frame_errors.push_back(history_row(point, scales));
}

ContourFrame contour_frame(const TimeFrame& frame, const Scales& scales) {
  Eigen::Index rows = 1;
  for (const CurvePiece& piece : frame.state.contour.pieces) rows += piece.rows() - 1;
  const double um = scales.length_um(), us = scales.time_us();
  ContourFrame result{us * frame.time, um * frame.position, Eigen::MatrixX2d(rows, 2), in_history(frame.state, scales)};
  Eigen::Index row = 0;
  for (const CurvePiece& piece : frame.state.contour.pieces) {  // a piece begins where the one before ends
    result.point_um.middleRows(row, piece.rows()) = um * piece;
    row += piece.rows() - 1;
  }
  for (const auto& [name, surface] : frame.state.views)
    if (name == "across") result.across_um = um * surface.point(surface.distinct_rows(), Eigen::all);
  result.offset_um = um * frame.state.offset_outline;
  return result;
}

namespace {

/// Empty where there are none.
std::string contours_text(const TimeRecord& record, Eigen::MatrixX2d ContourFrame::*points,
                          std::string_view across = "r_um") {
  if (record.frames.empty() || (record.frames.front().*points).rows() == 0) return {};
  const double least = across == "r_um" ? 0 : -HUGE_VAL;
  std::string text = fmt::format("t_us,x_um,{}\n", across);
  for (const ContourFrame& frame : record.frames)
    for (const auto& point : (frame.*points).rowwise())
      text += fmt::format("{:.10g},{:.8g},{:.8g}\n", frame.t_us, point(0), std::max(point(1), least));
  return text;
}

template <class Row>
std::vector<std::size_t> known_in(const std::vector<Row>& rows) {
  std::vector<std::size_t> known;
  for (std::size_t k = 0; k < history_measures.size(); ++k) {
    const auto is_known = [&](const Row& row) { return std::isfinite(row.measures[k]); };
    if (rows.empty() || history_measures[k].null_where.empty() || std::ranges::any_of(rows, is_known))
      known.push_back(k);
  }
  return known;
}

}  // namespace

std::vector<std::size_t> known_measures(const std::vector<HistoryRow>& rows) { return known_in(rows); }

std::string history_csv(const TimeRecord& record) {
  const std::vector<std::size_t> known = known_measures(record.rows);
  std::string text = "t_us";
  for (const std::size_t k : known) text += fmt::format(",{}", history_measures[k].name);
  for (const auto& field : history_fields()) text += fmt::format(",{}", field.name);
  for (const HistoryRow& row : record.rows) {
    text += fmt::format("\n{:.12g}", row.t_us);
    for (const std::size_t k : known) text += fmt::format(",{:.12g}", row.measures[k]);
    for (const auto& field : history_fields()) text += fmt::format(",{:.10g}", field.value(row));
  }
  return text + "\n";
}

namespace {

/// Time, place and measures.
template <class Row>
std::string measures_csv(const std::vector<Row>& rows, const std::vector<std::size_t>& known, int digits) {
  std::string text = "t_us,position_um";
  for (const std::size_t k : known) text += fmt::format(",{}", history_measures[k].name);
  for (const Row& row : rows) {
    text += fmt::format("\n{:.{}g},{:.{}g}", row.t_us, digits, row.position_um, digits);
    for (const std::size_t k : known) text += fmt::format(",{:.{}g}", row.measures[k], digits);
  }
  return text + "\n";
}

std::string errors_csv(const std::vector<HistoryRow>& errors, const std::vector<std::size_t>& known) {
  constexpr int digits = 4;
  return errors.empty() ? "" : measures_csv(errors, known, digits);
}

}  // namespace

std::string outputs_csv(const TimeRecord& record) {
  constexpr int digits = 12;
  return measures_csv(record.frames, known_in(record.frames), digits);
}

std::string history_errors_csv(const TimeRecord& record) {
  return errors_csv(record.row_errors, known_in(record.rows));
}

std::string outputs_errors_csv(const TimeRecord& record) {
  return errors_csv(record.frame_errors, known_in(record.frames));
}

std::string contours_csv(const TimeRecord& record) {
  return record.frames.empty() ? "t_us,x_um,r_um\n" : contours_text(record, &ContourFrame::point_um);
}

std::string contours_across_csv(const TimeRecord& record) { return contours_text(record, &ContourFrame::across_um); }

std::string contours_offset_csv(const TimeRecord& record) {
  return contours_text(record, &ContourFrame::offset_um, "y_um");
}

WallLine wall_line(const Problem& problem, const Scales& scales, double start, double end, int samples) {
  const WallProfile wall(problem.wall);
  const double um = scales.length_um();
  WallLine line;
  for (int i = 0; i <= samples; ++i) {
    const double x = start + (end - start) * i / samples;
    line.x_um.push_back(um * x);
    line.distance_um.push_back(um * problem.extent.width * wall.radius(x));
  }
  return line;
}

std::string channel_csv(const Problem& problem, const Scales& scales) {
  constexpr int samples = 500;
  constexpr double beyond = 4;  // tube radii
  const WallTable& table = problem.wall;
  const WallLine line = wall_line(problem, scales, table.x.front() - beyond, table.x.back() + beyond, samples);
  std::string text = "x_um,R_um\n";
  for (std::size_t i = 0; i < line.x_um.size(); ++i)
    text += fmt::format("{:.8g},{:.8g}\n", line.x_um[i], line.distance_um[i]);
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
