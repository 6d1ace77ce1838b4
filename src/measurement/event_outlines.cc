#include "measurement/event_outlines.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "measurement/shape_in_pixels.h"
#include "numeric/no_value.h"

namespace rheocyte {

EventOutlines::EventOutlines(const Recording& recording, double pixel_um)
    : recording_(recording), pixel_um_(pixel_um), picture_(recording.size_of_pictures()) {
  if (recording.has_contours()) return;
  size_ = recording.image_size("mask");
  assert(size_);
  picture_ = *size_;
  block_ = recording.image_rows_per_chunk("mask");
}

ShapeVector EventOutlines::features(std::size_t event) {
  const PixelContour contour = outline(event);
  if (contour.size() < fewest_outline_points) return ShapeVector::Constant(no_value);
  return shape_of_contour(contour, pixel_um_);
}

PixelContour EventOutlines::outline(std::size_t event) {
  if (!size_) return recording_.read_contour(event);
  if (event < first_ || event >= first_ + count_) {
    first_ = event - event % block_;
    count_ = std::min(block_, recording_.events() - first_);
    pixels_.resize(count_ * size_->pixels());
    recording_.read_images("mask", first_, count_, pixels_);
  }
  return finder_.contour_of({*size_, std::span(pixels_).subspan((event - first_) * size_->pixels(), size_->pixels())});
}

}  // namespace rheocyte
