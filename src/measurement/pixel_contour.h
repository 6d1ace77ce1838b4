// The outline of a cell in an image, and its mask.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rheocyte {

/// Centre of a pixel, counted from 0: x along the channel (column), y across it (row).
struct PixelPoint {
  std::int32_t x = 0, y = 0;
  friend bool operator==(const PixelPoint&, const PixelPoint&) = default;
};

/// The closed chain of a cell's outermost pixels, each a neighbour (also diagonally) of the next; the last is a
/// neighbour of the first. Either direction.
using PixelContour = std::vector<PixelPoint>;

struct ImageSize {
  std::size_t width = 0, height = 0;  ///< columns, rows
  std::size_t pixels() const { return width * height; }
  friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

/// One mask: row by row, anything but 0 belongs to the cell.
struct Mask {
  ImageSize size;
  std::span<const std::uint8_t> pixels;
};

}  // namespace rheocyte
