// The outline of the cell in a mask.
#pragma once
#include "measurement/pixel_contour.h"

namespace rheocyte {

/// Finds outlines; keeps its memory from mask to mask.
class ContourFinder {
 public:
  /// The longest of the outlines of all connected groups of pixels (diagonal neighbours are connected; holes do not
  /// count), as a chain of pixels that starts at the leftmost pixel of its first row and runs with the cell on its
  /// left in a picture whose rows go down. Empty if the mask is empty. Valid until the next call.
  const PixelContour& contour_of(const Mask& mask);

 private:
  struct Run {
    std::int32_t row, first, end;  ///< pixels [first, end) of a row
    std::int32_t parent;           ///< a run of the same group; its own number for the first run of a group
  };
  void find_runs(const Mask& mask);
  void connect_runs();
  std::int32_t group_of(std::int32_t run);
  void copy_with_margin();
  std::ptrdiff_t place_of(const Run& run) const;  // of its first pixel, in the copy
  void follow(const Run& start, PixelContour& contour) const;

  std::vector<Run> runs_;
  std::vector<std::uint8_t> framed_;  // what is set, inside a margin of one empty pixel: no neighbour is missing
  std::int32_t top_ = 0, left_ = 0, stride_ = 0;  // of the copy in the mask, without its margin; length of its rows
  PixelContour contour_, other_;
};

}  // namespace rheocyte
