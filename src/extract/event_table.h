// The text table with one line per event.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "infer/modulus_state.h"
#include "store/file_writer.h"

namespace rheocyte {

/// What a block of events has to say, all equally long.
struct EventBlock {
  std::span<const double> area_um2, deformation, viscosity_mPas, young_modulus_kPa;
  std::span<const double> standard_error_kPa;  ///< empty if unknown
  std::span<const ModulusState> state;
};

/// Writes tab-separated lines with the shortest decimals that give back single precision (relative 6e-8).
class EventTable {
 public:
  /// `remarks` go above the columns' names, each behind "# ". With a column for standard errors if they are known.
  /// UserError.
  EventTable(const std::filesystem::path& file, const std::vector<std::string>& remarks, bool has_errors);

  /// Appends events; the first one ever has number 1. UserError, e.g. if the disk is full.
  void append(const EventBlock& block);

  /// UserError if not everything could be written.
  void close() { file_.close(); }

 private:
  void write_out();

  FileWriter file_;
  std::string text_;
  bool has_errors_;
  std::size_t events_ = 0;
};

}  // namespace rheocyte
