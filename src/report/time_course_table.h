// What is reported of the cells that recordings saw along a channel, and of their population.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "extract/course_events.h"
#include "report/course_columns.h"
#include "shelf/square_section.h"
#include "store/watch.h"

namespace rheocyte {

struct CourseReport {
  std::vector<CourseRow> rows;
  std::vector<std::string> remarks;  ///< the settings, and the lines
  std::vector<std::string> lines;    ///< for the terminal
  PopulationEstimate population;
};

/// The file: a line for each row, the remarks below.
std::string course_text(const CourseReport& report);

class CourseTable {
 public:
  /// The table must outlive it. `section`: in which the cells were seen, see section_seen. UserError where it is the
  /// tube and the table is one of the square.
  CourseTable(const DynamicTable& table, std::optional<Section> section);

  /// UserError as course_cells, and if its flow or viscosity differs from that of the recordings before.
  void add(const CourseEvents& events, const std::string& name, double contraction_um);

  /// Of all recordings; `watch` is asked from cell to cell. UserError as check_places_seen, and if no cell is seen
  /// again and most events lie where the table has none.
  CourseReport report(const Watch& watch) const;

 private:
  struct Row {
    std::string recording;
    CourseCell cell;
    ChannelFlow flow;
  };
  CourseRow told(const Row& row, std::size_t number) const;
  void check_places(const std::vector<CourseCell>& cells) const;
  bool is_of_square() const;  ///< the table
  /// Whether the table's channel and liquid are not those of a recording.
  bool is_elsewhere(const CourseEvents& events) const;
  /// What is said where they are not.
  std::string section_text(const std::vector<CellImages>& cells) const;
  /// What is said of elongated cells; empty if they are not.
  std::string elongation_text(const CourseReport& report) const;

  const DynamicTable& table_;
  std::optional<Section> section_;
  SquareSection square_;
  bool are_elsewhere_ = false;  ///< the cells of any recording
  std::string square_table_;    ///< by which they are brought to the table's channel and liquid; empty: they are not
  double unsettled_ = 0;
  std::vector<Row> rows_;
  std::vector<std::string> remarks_;
  std::size_t outside_places_ = 0, outside_areas_ = 0;
};

}  // namespace rheocyte
