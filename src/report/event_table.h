// Text tables with one line per event.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/event_column.h"
#include "store/file_writer.h"
#include "store/work_in_turn.h"

namespace rheocyte {

/// With these words a table of events begins: its first line holds the names of all columns, so that programs of every
/// kind find them there.
inline constexpr std::string_view first_columns_of_events =
    "event\tarea_um2\tdeformation\tviscosity_mPas\tyoung_modulus_kPa\t";

/// The words with which one of ours begins, or those of an older version if the file begins with them.
std::string_view mark_of_events(const std::filesystem::path& file);

/// The remarks in lines of their own, each behind "# ".
std::string commented(const std::vector<std::string>& remarks);

/// Writes tab-separated lines, the number of the event first. Another thread makes the text.
class EventTable {
 public:
  /// `remarks` go below the columns' names. UserError.
  EventTable(const std::filesystem::path& file, const std::vector<std::string>& remarks,
             std::vector<ColumnDescription> columns);

  /// Appends events, of which each column has a value; the first one ever has number 1. UserError of events before,
  /// e.g. if the disk is full.
  void append(std::span<const std::span<const double>> values);

  /// Below the events so far. UserError.
  void remark(const std::vector<std::string>& remarks);

  /// UserError if not everything could be written.
  void close();

 private:
  void write(std::span<const std::vector<double>> values);

  FileWriter file_;
  std::string text_;
  std::vector<ColumnDescription> columns_;
  std::size_t events_ = 0;
  WorkInTurn writing_;  // the last member: it ends before what it writes to
};

}  // namespace rheocyte
