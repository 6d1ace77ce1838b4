// Volume and inertia ratios in the companion, beside area and deformation: complete without the recording.
#pragma once
#include <span>
#include <vector>

#include "extract/extraction.h"
#include "report/companion_writer.h"

namespace rheocyte {

class CompanionShapes {
 public:
  /// Adds what the recording stores, or what its contours or masks give if these are read for the moduli anyway. All
  /// must outlive the object.
  CompanionShapes(CompanionWriter& companion, const Recording& recording, Extraction& extraction);

  /// Of the events from `first` on.
  void write(std::size_t first, const EventBlock& block);

 private:
  CompanionWriter& companion_;
  const Recording& recording_;
  std::vector<const OutlineFeature*> stored_, measured_;
  std::vector<double> values_;
};

}  // namespace rheocyte
