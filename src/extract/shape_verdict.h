// Whether the cells of a recording have the shapes of the model, and what can be trusted if they have not
// (docs/real-cells.md).
#pragma once
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "extract/beside_axis.h"
#include "extract/distribution.h"
#include "extract/elongation_columns.h"
#include "numeric/no_value.h"

namespace rheocyte {

/// Median and its standard error, 1.25 robust sigma / sqrt(n); NaN without values.
struct Median {
  double value = no_value, error = no_value;
  double common_error = no_value;  ///< by what all events share (common_errors.h), where that is known

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.value, s.error, s.common_error);
  }
};

inline constexpr std::size_t fewest_for_a_trend = 20;  ///< events
inline constexpr double least_length_of_trend_um = 15;

/// How a feature changes along the channel.
struct Trend {
  double change = 0, error = 0;  ///< over the places that the recording sees
  double median = 0;             ///< of the feature
  /// Whether it changes by more than chance and by more than a twentieth of itself.
  bool is_changing() const;
};

/// 1.25 robust sigma / sqrt(n) beside the median of the finite values; NaN where there are too few.
Median median_with_error(std::vector<double> values);

/// Up to this median of the excess the shapes count as those of the model: few events may lie above by chance.
double max_excess_of_the_model(const Median& excess);

/// Another of the program's tables, whose cells have the shapes of a recording.
struct FittingTable {
  std::string identifier, cells;       ///< cells as in cells_in_words; all is empty or NaN if there is none
  Median excess;                       ///< over its inertia ratios
  double expected_inertia_ratio = 0;   ///< median
  double modulus_over_its = no_value;  ///< median of E from deformation by the table that is used / by this one

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.identifier, s.cells, s.excess, s.expected_inertia_ratio, s.modulus_over_its);
  }
};

/// Of the events of one recording inside the gates.
struct ShapeVerdict {
  std::size_t judged = 0;          ///< events with area, deformation and inertia ratio, red cells apart
  std::size_t elongated = 0;       ///< of these, flagged
  std::size_t red_cells = 0;       ///< inertia ratio above 2
  std::string missing;             ///< what the recording lacks, in a sentence; empty if nothing
  std::string inertia_ratio_from;  ///< the stored feature or "contour", "mask"; empty if there is none
  std::string model;               ///< the cells of the table, as in cells_in_words; empty if unknown
  std::string made_of;             ///< of a virtual recording: what the recording says of its cells, in a sentence
  FittingTable other;              ///< looked for where the shapes are not certainly those of the table
  Median excess;
  double inertia_ratio = 0, expected_inertia_ratio = 0, odd_fraction = 0;  ///< medians
  double seen_um = 0;  ///< along the channel, 5 % to 95 % of the events; NaN without pos_x
  Trend inertia_ratio_trend, deformation_trend, asymmetry_trend;
  Trend mode_4_trend;
  int direction = 0;          ///< in which the cells move: along +x or -x; 0 if that is unknown
  Median by_deformation_kPa;  ///< Young's modulus from area and deformation
  std::size_t with_deformation = 0, too_stiff = 0, too_soft = 0;  ///< events with it, and those that the table lacks
  ElongatedBy elongated_by = ElongatedBy::modes;
  Distribution elongated_kPa;                ///< Young's moduli by the table of elongated cells
  double elongated_common_error = no_value;  ///< of their median, relative (common_errors.h)
  std::size_t with_elongation = 0;           ///< events that have one
  double modulus_ratio = 0;                  ///< median of E from deformation / that; NaN if unknown
  Median elongation, axial_tension_Pa;
  Median cortex_mode_4, cortex_mode_5;  ///< c_4 and c_5 beyond those of the elongated solids, where outlines tell them
  BesideAxis beside_axis;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.judged, s.elongated, s.red_cells, s.missing, s.inertia_ratio_from, s.model, s.made_of, s.other,
                    s.excess, s.inertia_ratio, s.expected_inertia_ratio, s.odd_fraction, s.seen_um,
                    s.inertia_ratio_trend, s.deformation_trend, s.asymmetry_trend, s.mode_4_trend, s.direction,
                    s.by_deformation_kPa, s.with_deformation, s.too_stiff, s.too_soft, s.elongated_by, s.elongated_kPa,
                    s.elongated_common_error, s.with_elongation, s.modulus_ratio, s.elongation, s.axial_tension_Pa,
                    s.cortex_mode_4, s.cortex_mode_5, s.beside_axis);
  }

  double elongated_percent() const;
  /// Whether the shapes are those of the model.
  enum class Fit { unknown, model, other_table, doubtful, elongated, rounder };
  Fit fit() const;
  /// In one sentence.
  std::string text() const;
  /// Whether the outlines have the flat rear and the straight flanks of cells with a cortex, which no solid has.
  bool has_cortex_shapes() const;
  /// Whether so many more events lack a modulus from area and deformation at one end of the table than at the other
  /// that the median of the rest is not that of all.
  bool is_cut_off() const;
  /// Whether the outlines tell another modulus than area and deformation, beyond the errors of both.
  bool is_contradicted() const;
  /// Whether the outlines give nearly all events a modulus that is to be believed.
  bool is_told_by_outlines() const;
  /// Whether the shapes change along the channel as those of cells that creep, by so much that they tell no modulus.
  bool is_creeping() const;
  /// Which number is to be reported, and why; nothing without one.
  enum class Modulus { none, by_deformation, elongated };
  Modulus recommended() const;
  Median recommended_kPa() const;
  std::string recommended_text() const;
  /// "settled", "still changing", or why that is unknown, with numbers; of an asymmetry that changes, whether cells
  /// that approach the axis explain it.
  std::string trend_text() const;
};

/// For the terminal: the sentence, the trend, both moduli, and how many red cells there are; nothing if nothing is
/// known.
std::vector<std::string> shape_lines(const ShapeVerdict& verdict);

inline constexpr double max_inertia_ratio_of_cells = 2;  ///< red cells rest in a longer shape

}  // namespace rheocyte
