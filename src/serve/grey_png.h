// Pictures as files that every browser shows.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace rheocyte {

/// In pixels.
struct PictureSize {
  std::size_t width, height;
};

/// A PNG of 8 bit grey. The pixels, row by row, are stored as they are: no one waits for the few kilobytes that a
/// compression would save on the way within one machine.
std::string grey_png(const PictureSize& size, std::span<const std::uint8_t> pixels);

}  // namespace rheocyte
