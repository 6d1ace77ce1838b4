#include "instrument/worker.h"

#include <algorithm>
#include <cmath>

#include "measurement/contour_tilt.h"
#include "measurement/event_outlines.h"
#include "shape/outline_shape.h"

namespace rheocyte {

namespace {

/// Only one thread counts.
void increment(std::atomic<std::uint64_t>& count) {
  count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

std::size_t bytes_of_row(const rheocyte_cell_masks& masks) {
  return masks.format == RHEOCYTE_CELL_BITS ? (std::size_t{masks.width} + 7) / 8 : masks.width;
}

/// As `rheocyte extract` takes it where a recording does not store it.
double inertia_ratio_of(const Polygon& hull) {
  const PolygonMoments moments = hull.moments();
  HullAsymmetry shape;
  shape.moment_ratio = moments.mu02 / moments.mu20;
  return shape.inertia_ratio();
}

/// Whether the differences of its coordinates, and their products, are exact.
bool is_possible(std::span<const PixelPoint> contour, const ImageSize& most) {
  const auto is_within = [&](const PixelPoint& point) {
    return point.x >= 0 && std::size_t(point.x) < most.width && point.y >= 0 && std::size_t(point.y) < most.height;
  };
  return std::ranges::all_of(contour, is_within);
}

void forget_moduli(rheocyte_cell_result& cell, rheocyte_cell_state why) {
  cell.young_modulus_kPa = cell.young_modulus_error_kPa = no_value;
  cell.effective_modulus_kPa = cell.effective_modulus_error_kPa = no_value;
  cell.stiffness_kPa = cell.stiffness_error_kPa = no_value;
  cell.young_state = cell.effective_state = why;
}

}  // namespace

Worker::Worker(SetUp& set_up, const ImageSize& largest, std::size_t remembered)
    : set_up_(&set_up), largest_(largest), pixels_(largest.pixels()), recent_(remembered) {
  finder_.reserve(largest);
  measurer_.reserve(most_outline_points(largest), largest.width);
  ++set_up.users();
}

Worker::~Worker() {
  if (SetUp* const next = next_.load()) --next->users();
  --set_up_->users();
}

void Worker::use(SetUp& set_up) {
  ++set_up.users();
  if (SetUp* const never_used = next_.exchange(&set_up)) --never_used->users();
}

const SetUp& Worker::current() {
  if (next_.load(std::memory_order_relaxed) == nullptr) return *set_up_;
  SetUp* const next = next_.exchange(nullptr);
  if (!next->is_like(*set_up_)) recent_.forget();
  --set_up_->users();
  set_up_ = next;
  return *set_up_;
}

rheocyte_cell_counts Worker::counts() const {
  rheocyte_cell_counts all{.cells = cells_.load(std::memory_order_relaxed), .young = {}, .effective = {}};
  for (std::size_t state = 0; state < young_.size(); ++state) {
    all.young[state] = young_[state].load(std::memory_order_relaxed);
    all.effective[state] = effective_[state].load(std::memory_order_relaxed);
  }
  return all;
}

bool Worker::fits(const ImageSize& picture) const {
  return picture.width <= largest_.width && picture.height <= largest_.height;
}

Mask Worker::plain(const rheocyte_cell_masks& masks, std::size_t row_bytes, const std::uint8_t* pixels) {
  const ImageSize size{masks.width, masks.height};
  if (masks.format == RHEOCYTE_CELL_BYTES && row_bytes == size.width) return {size, {pixels, size.pixels()}};
  std::uint8_t* to = pixels_.data();
  for (std::size_t row = 0; row < size.height; ++row, to += size.width) {
    const std::uint8_t* const from = pixels + row * row_bytes;
    if (masks.format == RHEOCYTE_CELL_BYTES) {
      std::copy_n(from, size.width, to);
      continue;
    }
    for (std::size_t x = 0; x < size.width; ++x) to[x] = std::uint8_t(from[x / 8] >> (7 - x % 8) & 1);
  }
  return {size, {pixels_.data(), size.pixels()}};
}

std::int32_t Worker::from_masks(const rheocyte_cell_masks& masks, std::span<rheocyte_cell_result> results) {
  const ImageSize size{masks.width, masks.height};
  const std::size_t least_row = bytes_of_row(masks), row_bytes = masks.row_bytes ? masks.row_bytes : least_row;
  if (size.pixels() == 0 || !fits(size) || masks.format > RHEOCYTE_CELL_BITS || row_bytes < least_row)
    return RHEOCYTE_CELL_BAD_PICTURE;
  const std::size_t mask_bytes = masks.mask_bytes ? masks.mask_bytes : size.height * row_bytes;
  const SetUp& set_up = current();
  const std::uint8_t* pixels = masks.pixels;
  for (rheocyte_cell_result& result : results) {
    measure(set_up, finder_.contour_of(plain(masks, row_bytes, pixels)), size, result);
    if (result.outline == RHEOCYTE_CELL_OUTLINE_WHOLE && finder_.groups() > 1)
      result.outline = RHEOCYTE_CELL_OUTLINE_IN_PIECES;
    pixels += mask_bytes;
  }
  return RHEOCYTE_CELL_OK;
}

std::int32_t Worker::from_contour(std::span<const PixelPoint> contour, const ImageSize& picture,
                                  rheocyte_cell_result& result) {
  if (!fits(picture) || (picture.width == 0) != (picture.height == 0)) return RHEOCYTE_CELL_BAD_PICTURE;
  if (contour.size() > most_outline_points(largest_) ||
      !is_possible(contour, picture.pixels() > 0 ? picture : largest_))
    return RHEOCYTE_CELL_BAD_CONTOUR;
  measure(current(), contour, picture, result);
  return RHEOCYTE_CELL_OK;
}

void Worker::measure(const SetUp& set_up, std::span<const PixelPoint> contour, const ImageSize& picture,
                     rheocyte_cell_result& result) {
  const ContourFeatures features = measurer_.measure(contour, set_up.pixel_size_um());
  const bool is_cut = rheocyte::is_cut(contour, picture);
  const bool is_small = contour.size() < fewest_outline_points || std::isnan(features.area_um2);
  result.area_um2 = features.area_um2;
  result.deformation = features.deformation;
  result.inertia_ratio = is_small || is_cut ? no_value : inertia_ratio_of(measurer_.hull());
  result.x_um = features.x_um;
  result.y_um = features.y_um;
  result.outline = contour.empty() ? RHEOCYTE_CELL_OUTLINE_EMPTY
                   : is_cut        ? RHEOCYTE_CELL_OUTLINE_AT_EDGE
                   : is_small      ? RHEOCYTE_CELL_OUTLINE_TOO_SMALL
                                   : RHEOCYTE_CELL_OUTLINE_WHOLE;
  set_up.add_moduli({&result, 1});
  if (is_cut) forget_moduli(result, RHEOCYTE_CELL_CUT);
  remember(result);
}

void Worker::from_features(std::span<const double> area_um2, std::span<const double> deformation,
                           std::span<const double> inertia_ratio, std::span<rheocyte_cell_result> results) {
  const SetUp& set_up = current();
  for (std::size_t i = 0; i < results.size(); ++i) {
    rheocyte_cell_result& result = results[i];
    result.area_um2 = area_um2[i];
    result.deformation = deformation[i];
    result.inertia_ratio = inertia_ratio.empty() ? no_value : inertia_ratio[i];
    result.x_um = result.y_um = no_value;
    result.outline = RHEOCYTE_CELL_OUTLINE_NOT_GIVEN;
  }
  for (std::size_t first = 0; first < results.size(); first += SetUp::most_together)
    set_up.add_moduli(results.subspan(first, std::min(SetUp::most_together, results.size() - first)));
  for (const rheocyte_cell_result& result : results) remember(result);
}

void Worker::remember(const rheocyte_cell_result& result) {
  increment(cells_);
  increment(young_[std::size_t(result.young_state)]);
  increment(effective_[std::size_t(result.effective_state)]);
  // A cut cell has no inertia ratio, and does not count.
  if (std::isfinite(result.inertia_ratio)) recent_.add(result.area_um2, result.deformation, result.inertia_ratio);
}

}  // namespace rheocyte
