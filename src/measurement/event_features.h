// Any feature of the events by its name, also those that the recording only implies.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "measurement/recording.h"
#include "measurement/shape_source.h"

namespace rheocyte {

class EventFeatures {
 public:
  /// Both must outlive it.
  EventFeatures(const Recording& recording, ShapeSource& shapes) : recording_(recording), shapes_(shapes) {}

  const Recording& recording() const { return recording_; }

  /// Stored features, area_um and deform from whatever tells them, area_ratio from area_cvx and area_msd.
  bool has(const std::string& feature) const;
  /// All that has() knows.
  std::vector<std::string> names() const;
  /// " Did you mean ...?" for a feature that the recording does not have; empty if none has a similar name.
  std::string near(const std::string& feature) const;

  /// Values of events [first, first + values.size()); NaN where there is none. UserError if the recording does not have
  /// the feature, or its data are damaged.
  void read(const std::string& feature, std::size_t first, std::span<double> values);

 private:
  const Recording& recording_;
  ShapeSource& shapes_;
  std::vector<double> other_;
};

}  // namespace rheocyte
