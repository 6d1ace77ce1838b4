// Whether the cells of a recording have the shapes of the model, and what can be trusted if they have not
// (docs/real-cells.md).
#pragma once
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "extract/beside_axis.h"
#include "extract/distribution.h"
#include "extract/effective_cell.h"
#include "extract/elongation_values.h"
#include "extract/median.h"
#include "numeric/censored_median.h"
#include "numeric/density_maxima.h"
#include "numeric/no_value.h"

namespace rheocyte {

inline constexpr std::size_t fewest_for_a_trend = 20;  ///< events
inline constexpr double least_length_of_trend_um = 15;

/// How a feature changes along the channel.
struct Trend {
  double change = 0, error = 0;  ///< over the places that the recording sees
  double median = 0;             ///< of the feature
  /// Whether it changes by more than chance and by more than a twentieth of itself.
  bool is_changing() const;
};

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

/// One of the moduli that a recording can report: from area and deformation, or of elongated cells.
struct JudgedModulus {
  CensoredMedian median_kPa;          ///< of all events, red cells and sizes outside the table apart
  double soft_end_kPa = no_value;     ///< of the softest cell of the table that has the size of those that are softer
  double common_error = no_value;     ///< of the median, relative (common_errors.h)
  double least_error_kPa = no_value;  ///< of the median, by the errors of the events alone
  DensityMaxima log_maxima = {};      ///< of ln(E / kPa) of the events that have one

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.median_kPa, s.soft_end_kPa, s.common_error, s.least_error_kPa, s.log_maxima);
  }
};

/// Of the events of one recording inside the gates.
struct ShapeVerdict {
  std::size_t judged = 0;          ///< events with area, deformation and inertia ratio, red cells apart
  std::size_t elongated = 0;       ///< of these, flagged
  std::size_t red_cells = 0;       ///< as is_red_cell (plausibility.h) says
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
  int direction = 0;             ///< in which the cells move: along +x or -x; 0 if that is unknown
  JudgedModulus by_deformation;  ///< Young's modulus from area and deformation
  bool has_elongated_table = false;
  ElongatedBy elongated_by = ElongatedBy::modes;
  JudgedModulus by_elongation;      ///< Young's modulus by the table of elongated cells
  Distribution elongated_kPa;       ///< of the events that have one
  std::size_t with_elongation = 0;  ///< their number
  double modulus_ratio = 0;         ///< median of E from deformation / that; NaN if unknown
  double asymmetry = no_value;      ///< median of c_3
  double radius_px = no_value;      ///< of the circle with the median area, where the size of the pixels is known
  Median elongation, axial_tension_Pa;
  EffectiveCell effective;              ///< of cells that are longer than the flow makes them
  bool is_tension_given = false;        ///< the axial tension of the liquid, by which cells have an effective modulus
  Median cortex_mode_4, cortex_mode_5;  ///< c_4 and c_5 beyond those of the elongated solids, where outlines tell them
  BesideAxis beside_axis;
  bool are_shapes_gated = false;  ///< gates select cells by their shapes (Gates::limit_shapes)
  /// The modulus that is recommended if these gates are lifted. Its difference is an error of the recommended modulus.
  double without_shape_gates_kPa = no_value;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.judged, s.elongated, s.red_cells, s.missing, s.inertia_ratio_from, s.model, s.made_of, s.other,
                    s.excess, s.inertia_ratio, s.expected_inertia_ratio, s.odd_fraction, s.seen_um,
                    s.inertia_ratio_trend, s.deformation_trend, s.asymmetry_trend, s.mode_4_trend, s.direction,
                    s.by_deformation, s.has_elongated_table, s.elongated_by, s.by_elongation, s.elongated_kPa,
                    s.with_elongation, s.modulus_ratio, s.asymmetry, s.radius_px, s.elongation, s.axial_tension_Pa,
                    s.effective, s.is_tension_given, s.cortex_mode_4, s.cortex_mode_5, s.beside_axis,
                    s.are_shapes_gated, s.without_shape_gates_kPa);
  }

  double elongated_percent() const;
  /// Whether the shapes are those of the model.
  enum class Fit { unknown, model, other_table, doubtful, elongated, rounder };
  Fit fit() const;
  /// In one sentence.
  std::string text() const;
  /// Whether the outlines have the flat rear and the straight flanks of cells with a cortex, which no solid has.
  bool has_cortex_shapes() const;
  /// Whether the effective modulus is theirs: they are longer than the flow makes them, and their outlines, where there
  /// are some, do not show that they are solids.
  bool has_effective_modulus() const;
  /// Whether the shapes change along the channel as those of cells that creep, by so much that no modulus follows.
  bool is_creeping() const;
  /// "settled", "still changing", or why that is unknown, with numbers; of an asymmetry that changes, whether cells
  /// that approach the axis explain it.
  std::string trend_text() const;
};

inline constexpr std::size_t fewest_for_a_verdict = 5;  ///< events

}  // namespace rheocyte
