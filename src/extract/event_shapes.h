// The shapes of a recording's events against those of a table, and their moduli from the asymmetry of the outline.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "extract/elongation_values.h"
#include "infer/elongated_liquid.h"
#include "infer/shape_map.h"
#include "measurement/contour_features.h"
#include "measurement/event_outlines.h"
#include "measurement/recording.h"

namespace rheocyte {

/// One value per event of a block.
struct ShapeColumns {
  std::vector<double> inertia_ratio, x_um;   ///< NaN where unknown
  std::vector<double> mode_2, mode_3;        ///< of a cell that moves towards +x; empty without contours and masks
  std::vector<double> mode_4, mode_5, y_um;  ///< likewise; y is pos_y, or that of the outline where it is not stored
  std::vector<double> mode_4_excess, mode_5_excess;  ///< beyond those of the elongated solid; empty without one
  std::vector<OutlineTilt> tilt;  ///< likewise; NaN of outlines that are cut by the border or too small
  std::vector<char> is_cut;       ///< by the edge of the picture: no shape is known; empty without contours and masks
  std::vector<ShapeExcess> excess;
  ElongationValues elongation;            ///< empty without a table of elongated cells
  std::vector<ContourFeatures> outlines;  ///< empty unless measure_outlines() was called
};

class EventShapes {
 public:
  /// Whether a recording has anything to compare with the shapes of a table, which then must be read.
  static bool are_measured(const Recording& recording);

  /// The tables with which shapes are compared, which must outlive it; null where there is none.
  struct Tables {
    const ShapeMap* round = nullptr;  ///< without it nothing is known
    const ElongatedLiquid* elongated = nullptr;
  };
  /// The recording must outlive it. `with_asymmetry`: contours or masks are read, where there are any. UserError if the
  /// data are damaged.
  EventShapes(const Recording& recording, const MeasuringConditions& conditions, const Tables& tables,
              bool with_asymmetry);

  bool is_known() const { return tables_.round != nullptr && !inertia_ratio_from_.empty(); }
  /// Whether outlines are read.
  bool has_asymmetry() const { return outlines_.has_value(); }
  /// By what moduli of elongated cells are told; nothing if they are not.
  std::optional<ElongatedBy> elongated_by() const;
  const ShapeMap* map() const { return tables_.round; }
  /// Null without one.
  const ElongatedLiquid* elongated_table() const { return elongated_by() ? tables_.elongated : nullptr; }
  const std::string& inertia_ratio_from() const { return inertia_ratio_from_; }
  /// In which the cells move, from the sign of the mean asymmetry: +1, -1 along x, 0 if chance decides.
  int direction() const { return direction_; }
  /// What the recording lacks, and what therefore is not known; empty if nothing.
  const std::string& missing() const { return missing_; }

  /// From now on the features of the outlines are told, too, where contours or masks are read. The size is above 0.
  void measure_outlines(double pixel_size_um) { measured_pixel_um_ = pixel_size_um; }

  /// Of the events from `first` on; between calls the columns are the caller's, but nobody else's.
  void compute(std::size_t first, const MeasuredEvents& events, ShapeColumns& columns);

 private:
  void read_outlines(std::size_t first, ShapeColumns& columns);
  void compare_with_solids(const MeasuredEvents& events, ShapeColumns& columns) const;
  /// NaN where there is no cell, or no whole one. The features are told, too, if `measured` is given. The hull is that
  /// of the measurer.
  HullAsymmetry asymmetry(const PixelContour& contour, ContourFeatures* measured);

  const Recording& recording_;
  MeasuringConditions conditions_;
  Tables tables_;
  std::optional<EventOutlines> outlines_;
  double measured_pixel_um_ = 0;  ///< 0: outlines are not measured
  ContourMeasurer measurer_;
  std::string inertia_ratio_from_, missing_;
  int direction_ = 0;
};

}  // namespace rheocyte
