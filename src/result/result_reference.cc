#include "result/result_reference.h"

#include <fmt/format.h>

#include <vector>

#include "result/result.h"
#include "result/time_record.h"

namespace rheocyte {

namespace {

struct Row {
  std::string name, sentence;
};

struct Chapter {
  std::string title, opening;
  std::vector<Row> rows;
};

template <class List>
std::vector<Row> rows_of(const List& fields) {
  std::vector<Row> rows;
  for (const auto& field : fields) rows.push_back({std::string(field.name), std::string(field.sentence)});
  return rows;
}

std::vector<Row> rows_of_measures() {
  std::vector<Row> rows = rows_of(state_measures);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const StateMeasure& measure = state_measures[i];
    if (!measure.null_where.empty()) rows[i].sentence += fmt::format("; null {}", measure.null_where);
    if (measure.in_history()) rows[i].sentence += "; in history.csv, too";
    if (measure.in_tables()) rows[i].sentence += "; in tables, too";
  }
  return rows;
}

void add_measures(std::vector<Row>& rows) {
  for (const StateMeasure& measure : history_measures) {
    Row& row = rows.emplace_back(Row{std::string(measure.name), "as in result.json"});
    if (!measure.null_where.empty()) row.sentence += "; no column where it is null";
  }
}

std::vector<Row> rows_of_history() {
  std::vector<Row> rows{{"t_us", "time since the start"}};
  add_measures(rows);
  for (const auto& row : rows_of(history_fields())) rows.push_back(row);
  return rows;
}

std::vector<Row> rows_of_outputs() {
  std::vector<Row> rows{{"t_us", "time since the start"}, {"position_um", "as in history.csv"}};
  add_measures(rows);
  return rows;
}

/// Time, place and measures, with the sentences of outputs.csv.
std::vector<Row> rows_of_errors() {
  std::vector<Row> rows{{"t_us", "of a run that ends, or of outputs that are, at a place; else 0"},
                        {"position_um", "of its place at that time"}};
  for (Row& row : rows_of_outputs())
    if (row.name != "t_us" && row.name != "position_um") rows.push_back({row.name, "of this measure"});
  return rows;
}

std::vector<Chapter> chapters() {
  return {
      {"result.json", "How the computation ended, and for which moduli:", rows_of(outcome_fields())},
      {"Measures in result.json", "Of the state, or of the last one on the way to it:", rows_of_measures()},
      {"Computation in result.json", "What was computed, and how:", rows_of(computation_fields())},
      {"branch in result.json", "Each of its steps has:", rows_of(branch_fields())},
      {"statistics in result.json", "Of the solver:", rows_of(statistics_fields())},
      {"threads in result.json", "Of the machine:", rows_of(thread_fields())},
      {"time in result.json", "Of a case in time:", rows_of(time_fields())},
      {"history.csv", "Of a case in time, one line for each step:", rows_of_history()},
      {"outputs.csv", "Of a case in time, one line for each output, between steps:", rows_of_outputs()},
      {"history_errors.csv",
       "Of history.csv, line by line, estimated errors, absolute, each under the name and in the unit of its number; "
       "not "
       "there where they are not known (see time.comparison in result.json):",
       rows_of_errors()},
      {"outputs_errors.csv", "The same of outputs.csv:", rows_of_errors()},
      {"contour.csv",
       "The surface from the front pole to the rear one, in a square channel or a rectangle along the silhouette "
       "that the camera sees "
       "(contour_side.csv, and contour_diagonal.csv of a square or contour_across.csv of a rectangle or funnel, along "
       "its width: along these):",
       rows_of(contour_fields())},
      {"contour_offset.csv",
       "Of a cell off the axis, its closed convex outline in the plane of the flow and the offset, from the front on:",
       {{"x_um", "along the flow, from the barycentre"}, {"y_um", "along the offset, from the axis"}}},
      {"contours.csv",
       "Of a case in time, the contours one after another:",
       {{"t_us", "time"}, {"x_um", "as in contour.csv"}, {"r_um", "as in contour.csv"}}},
      {"contours_across.csv",
       "The same of a cell in a rectangle or a funnel in three dimensions, seen along the width:",
       {{"t_us", "time"}, {"x_um", "as in contour.csv"}, {"r_um", "as in contour.csv"}}},
      {"contours_offset.csv",
       "Of a case in time with a cell off the axis, its outlines in the plane of the offset, as in contour_offset.csv:",
       {{"t_us", "time"},
        {"x_um", "along the flow, from the barycentre"},
        {"y_um", "along the offset, from the axis"}}},
      {"channel.csv",
       "The wall of a channel that is not straight:",
       {{"x_um", "along the channel, from the start of the cell"}, {"R_um", "radius; in a duct half its width"}}}};
}

constexpr std::string_view rules =
    "A name ends with its unit; one without is a pure number or a word. Numbers that are not known are null.\n";

}  // namespace

std::string result_reference(bool markdown) {
  std::string text = markdown ? "# Result reference\n\nGenerated by `rheocyte help result --markdown` from the lists "
                                "that the files are written from; a test keeps it up to date.\n\n"
                              : "Contents of the files of a result.\n";
  text += rules;
  for (const auto& [title, opening, rows] : chapters()) {
    if (markdown)
      text += fmt::format("\n## {}\n\n{}\n\n| name | unit | meaning |\n|---|---|---|\n", title, opening);
    else
      text += fmt::format("\n{}: {}\n", title, opening);
    for (const auto& [name, sentence] : rows)
      if (markdown)
        text += fmt::format("| `{}` | {} | {} |\n", name, unit_of(name).symbol, sentence);
      else
        text += fmt::format("  {:<32} {:<7} {}\n", name, unit_of(name).symbol, sentence);
  }
  return text;
}

}  // namespace rheocyte
