// The text table with one line per event.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "extract/elongation_columns.h"
#include "infer/modulus_state.h"
#include "infer/shape_excess.h"
#include "measurement/contour_features.h"
#include "shape/outline_tilt.h"
#include "store/file_writer.h"

namespace rheocyte {

/// What a block of events has to say, all equally long.
struct EventBlock {
  std::span<const double> area_um2, deformation, viscosity_mPas, young_modulus_kPa;
  std::span<const double> standard_error_kPa;  ///< empty if unknown
  std::span<const ModulusState> state;
  std::span<const ShapeExcess> shape;  ///< empty if nothing is known of the shapes
  std::span<const double> mode_3;      ///< empty without contours and masks
  ElongationBlock elongation;
  std::span<const ContourFeatures> outlines;  ///< empty unless they are measured, too
  std::span<const OutlineTilt> tilt;          ///< empty without contours and masks
};

/// Columns beside those that every table of events has.
struct EventColumns {
  bool errors = false, shapes = false, asymmetry = false;
  std::vector<ElongationColumn> elongation = {};
};

/// With these words a table of events begins: its first line holds the names of all columns, so that programs of every
/// kind find them there.
inline constexpr std::string_view first_columns_of_events =
    "event\tarea_um2\tdeformation\tviscosity_mPas\tyoung_modulus_kPa\t";

/// The words with which one of ours begins, or those of an older version if the file begins with them.
std::string_view mark_of_events(const std::filesystem::path& file);

/// The remarks in lines of their own, each behind "# ".
std::string commented(const std::vector<std::string>& remarks);

/// Writes tab-separated lines with the shortest decimals that give back single precision (relative 6e-8).
class EventTable {
 public:
  /// `remarks` go below the columns' names, each behind "# ". UserError.
  EventTable(const std::filesystem::path& file, const std::vector<std::string>& remarks, const EventColumns& columns);

  /// Appends events; the first one ever has number 1. UserError, e.g. if the disk is full.
  void append(const EventBlock& block);

  /// UserError if not everything could be written.
  void close() { file_.close(); }

 private:
  void write_out();

  FileWriter file_;
  std::string text_;
  EventColumns columns_;
  std::size_t events_ = 0;
};

}  // namespace rheocyte
