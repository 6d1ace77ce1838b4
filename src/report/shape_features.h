// Features of events that come from comparing their shapes with those of a table, by their names.
#pragma once
#include <string>
#include <vector>

#include "events/extract_settings.h"
#include "extract/event_shapes.h"
#include "measurement/shape_source.h"
#include "report/plot_options.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {

inline constexpr const char *expected_ratio_feature = "inertia_ratio_expected", *ratio_feature = "inertia_ratio";

class ShapeFeatures {
 public:
  /// inertia_ratio, inertia_ratio_expected, shape_excess, odd_fraction, mode_3, and those of tilt_features().
  static bool knows(const std::string& feature);

  /// The recording and the source must outlive it. UserError naming what the recording lacks.
  ShapeFeatures(const Recording& recording, ShapeSource& source, const PlotOptions& options);

  /// Of events [first, first + values.size()); NaN where there is none.
  void read(const std::string& feature, std::size_t first, std::span<double> values);

 private:
  void compute(std::size_t first, std::size_t count);

  const Recording& recording_;
  ShapeSource& source_;
  ExtractSettings settings_;
  ModulusTables tables_;
  EventShapes shapes_;
  std::vector<double> area_, deformation_, viscosity_;
  ShapeColumns columns_;
  std::size_t first_ = 0;
};

}  // namespace rheocyte
