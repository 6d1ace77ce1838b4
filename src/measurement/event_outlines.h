// The shapes of a recording's cells from their contours or masks, event by event.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "measurement/contour_from_mask.h"
#include "measurement/recording.h"
#include "shape/outline_shape.h"

namespace rheocyte {

inline constexpr std::size_t fewest_outline_points = 12;  ///< of an outline that is a cell

class EventOutlines {
 public:
  /// The recording, which must outlive it, has contours or masks (asserted): see ShapeSource::has_outlines().
  EventOutlines(const Recording& recording, double pixel_um);

  /// NaN where there is no cell. UserError if the data are damaged.
  ShapeVector features(std::size_t event);
  /// Empty where there is no cell. UserError if the data are damaged.
  PixelContour outline(std::size_t event);
  /// The size of the pictures; 0 x 0 if unknown.
  const ImageSize& picture() const { return picture_; }
  std::size_t events() const { return recording_.events(); }

 private:
  const Recording& recording_;
  double pixel_um_;
  std::optional<ImageSize> size_;  ///< of the masks, if there are no contours
  ImageSize picture_;
  std::size_t block_ = 1, first_ = 0, count_ = 0;  ///< events whose masks are at hand
  std::vector<std::uint8_t> pixels_;
  ContourFinder finder_;
};

}  // namespace rheocyte
