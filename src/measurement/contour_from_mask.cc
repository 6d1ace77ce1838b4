#include "measurement/contour_from_mask.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace rheocyte {

namespace {

// The eight neighbours in the order of the compass, against the clock as seen in the picture: E, NE, N, NW, W, ...
constexpr std::array<std::int32_t, 8> step_x{1, 1, 0, -1, -1, -1, 0, 1};
constexpr std::array<std::int32_t, 8> step_y{0, -1, -1, -1, 0, 1, 1, 1};
constexpr int west = 4;
static_assert(std::endian::native == std::endian::little);

std::uint64_t eight_pixels(const std::uint8_t* at) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, at, sizeof eight);
  return eight;
}

// The high bit of each byte that is 0, exact up to the first of them.
std::uint64_t zeros_among(std::uint64_t bytes) {
  constexpr std::uint64_t ones = 0x0101010101010101, high_bits = 0x8080808080808080;
  return (bytes - ones) & ~bytes & high_bits;
}

// Of eight pixels the first one with a bit set here; the first pixel of a row lies in the lowest byte.
std::size_t first_of(std::uint64_t bits) { return static_cast<std::size_t>(std::countr_zero(bits)) / 8; }

// The first place from `at` on whose pixel is set; 64 pixels at a time while they are all empty, then eight.
std::size_t next_set(std::span<const std::uint8_t> pixels, std::size_t at) {
  constexpr std::size_t many = 64;
  const std::size_t end = pixels.size();
  for (; at + many <= end; at += many) {
    std::uint8_t any = 0;
    for (std::size_t i = 0; i < many; ++i) any |= pixels[at + i];
    if (any != 0) break;
  }
  for (; at + 8 <= end; at += 8)
    if (const std::uint64_t eight = eight_pixels(pixels.data() + at); eight != 0) return at + first_of(eight);
  while (at < end && pixels[at] == 0) ++at;
  return at;
}

// Not beyond the end of the span.
std::size_t next_empty(std::span<const std::uint8_t> pixels, std::size_t at) {
  const std::size_t end = pixels.size();
  for (; at + 8 <= end; at += 8)
    if (const std::uint64_t zeros = zeros_among(eight_pixels(pixels.data() + at)); zeros != 0)
      return at + first_of(zeros);
  while (at < end && pixels[at] != 0) ++at;
  return at;
}

}  // namespace

// The empty ends of rows are passed over together with those of the next ones.
void ContourFinder::find_runs(const Mask& mask) {
  runs_.clear();
  const std::size_t width = mask.size.width, all = mask.size.pixels();
  const auto pixels = mask.pixels.first(all);
  for (std::size_t at = next_set(pixels, 0); at < all;) {
    const std::size_t row = at / width;
    const std::size_t end = next_empty(pixels.first((row + 1) * width), at);
    runs_.push_back({static_cast<std::int32_t>(row), static_cast<std::int32_t>(at - row * width),
                     static_cast<std::int32_t>(end - row * width), static_cast<std::int32_t>(runs_.size())});
    at = next_set(pixels, end);
  }
}

std::int32_t ContourFinder::group_of(std::int32_t run) {
  while (runs_[run].parent != run) run = runs_[run].parent = runs_[runs_[run].parent].parent;
  return run;
}

// Runs of neighbouring rows that touch, diagonally too, join the group whose first run comes first.
void ContourFinder::connect_runs() {
  std::size_t above = 0;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const Run& run = runs_[i];
    while (above < i &&
           (runs_[above].row < run.row - 1 || (runs_[above].row == run.row - 1 && runs_[above].end < run.first)))
      ++above;
    for (std::size_t k = above; k < i && runs_[k].row == run.row - 1 && runs_[k].first <= run.end; ++k) {
      const std::int32_t one = group_of(static_cast<std::int32_t>(k)), two = group_of(static_cast<std::int32_t>(i));
      runs_[std::max(one, two)].parent = std::min(one, two);
    }
  }
}

// The rectangle around all that is set, with one empty pixel on each side.
void ContourFinder::copy_with_margin() {
  top_ = runs_.front().row;
  left_ = std::ranges::min(runs_, {}, &Run::first).first;
  stride_ = std::ranges::max(runs_, {}, &Run::end).end - left_ + 2;
  const std::int32_t rows = runs_.back().row - top_ + 3;
  framed_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows), 0);
  for (const Run& run : runs_)
    std::memset(framed_.data() + place_of(run), 1, static_cast<std::size_t>(run.end - run.first));
}

std::ptrdiff_t ContourFinder::place_of(const Run& run) const {
  return static_cast<std::ptrdiff_t>(run.row - top_ + 1) * stride_ + run.first - left_ + 1;
}

// Border following: from each pixel the neighbours are searched against the clock, from the one after that from which
// the walk came. The start's left neighbour is empty, so the walk is that of the outer border.
void ContourFinder::follow(const Run& start, PixelContour& contour) const {
  contour.clear();
  std::array<std::ptrdiff_t, 8> offset{};
  for (int d = 0; d < 8; ++d) offset[d] = step_y[d] * static_cast<std::ptrdiff_t>(stride_) + step_x[d];
  const std::uint8_t* const first = framed_.data() + place_of(start);
  const std::uint8_t* here = first;
  PixelPoint point{start.first, start.row};
  int search = west + 1, first_direction = -1;
  for (;;) {
    int direction = search & 7, tried = 0;
    while (tried < 8 && !here[offset[direction]]) {
      direction = (direction + 1) & 7;
      ++tried;
    }
    if (tried == 8) {  // a lonely pixel
      contour.push_back(point);
      return;
    }
    if (here == first) {
      if (direction == first_direction) return;
      if (first_direction < 0) first_direction = direction;
    }
    contour.push_back(point);
    here += offset[direction];
    point.x += step_x[direction];
    point.y += step_y[direction];
    search = direction + 6;  // from the neighbour after the one that the walk left: two eighths back
  }
}

const PixelContour& ContourFinder::contour_of(const Mask& mask) {
  contour_.clear();
  find_runs(mask);
  if (runs_.empty()) return contour_;
  connect_runs();
  copy_with_margin();
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (runs_[i].parent != static_cast<std::int32_t>(i)) continue;
    follow(runs_[i], other_);
    if (other_.size() > contour_.size()) std::swap(contour_, other_);
  }
  return contour_;
}

}  // namespace rheocyte
