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
  /// Connected groups of pixels in the last mask.
  std::size_t groups() const { return groups_; }

  /// Memory for any mask that has no more rows and columns: contour_of() then takes no more.
  void reserve(const ImageSize& largest);

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
  std::size_t groups_ = 0;
};

/// Points of an outline in a picture of this size at most: one for each edge between two pixels, or a pixel and the
/// margin.
inline std::size_t most_outline_points(const ImageSize& picture) {
  return 2 * picture.pixels() + picture.width + picture.height;
}

}  // namespace rheocyte
