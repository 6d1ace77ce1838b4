#include "measurement/event_outlines.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "measurement/contour_tilt.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

/// Events that another thread is given at once, and those of a block of masks up to which it is.
constexpr std::size_t fewest_together = 32, most_together = 4096;

}  // namespace

EventOutlines::EventOutlines(const Recording& recording, double pixel_um)
    : recording_(recording),
      pixel_um_(pixel_um),
      are_contours_(recording.has_contours()),
      picture_(recording.size_of_pictures()) {
  if (are_contours_) return;
  const auto size = recording.image_size("mask");
  assert(size);
  picture_ = *size;
  block_ = recording.image_rows_per_chunk("mask");
}

void EventOutlines::read(std::size_t first, std::size_t count, Stored& stored) const {
  stored.first = first;
  stored.count = 0;  // as long as not all is read
  if (are_contours_) {
    stored.contours.resize(count);
    for (std::size_t i = 0; i < count; ++i) stored.contours[i] = recording_.read_contour(first + i);
  } else {
    stored.pixels.resize(count * picture_.pixels());
    recording_.read_images("mask", first, count, stored.pixels);
  }
  stored.count = count;
}

const PixelContour& EventOutlines::contour(const Stored& stored, std::size_t event) {
  assert(stored.has(event));
  const std::size_t i = event - stored.first;
  if (are_contours_) return stored.contours[i];
  return finder_.contour_of({picture_, std::span(stored.pixels).subspan(i * picture_.pixels(), picture_.pixels())});
}

const PixelContour& EventOutlines::contour_at_hand(std::size_t event) {
  if (!at_hand_.has(event)) {
    const std::size_t first = event - event % block_;
    read(first, std::min(block_, recording_.events() - first), at_hand_);
  }
  return contour(at_hand_, event);
}

void EventOutlines::each(std::size_t first, std::size_t count,
                         const std::function<void(std::size_t event, const PixelContour&)>& work) {
  const std::size_t end = first + count;
  if (block_ > most_together) {  // no block is read twice, nor are several kept
    for (; first < end; ++first) work(first, contour_at_hand(first));
    return;
  }
  const std::size_t together = block_ * ((fewest_together + block_ - 1) / block_);
  WorkInTurn pieces;
  for (std::size_t piece = 0; first < end; ++piece) {
    Stored& stored = in_turn_[piece % in_turn_.size()];
    read(first, std::min(together - first % together, end - first), stored);
    first += stored.count;
    pieces.add([&] {
      for (std::size_t i = 0; i < stored.count; ++i) work(stored.first + i, contour(stored, stored.first + i));
    });
  }
  pieces.finish();
}

ShapeVector EventOutlines::features(std::size_t event) {
  const PixelContour& contour = contour_at_hand(event);
  if (contour.size() < fewest_outline_points || is_cut(contour)) return ShapeVector::Constant(no_value);
  return shape_of_contour(contour, pixel_um_);
}

bool EventOutlines::is_cut(const PixelContour& contour) const { return rheocyte::is_cut(contour, picture_); }

PixelContour EventOutlines::outline(std::size_t event) { return contour_at_hand(event); }

}  // namespace rheocyte
