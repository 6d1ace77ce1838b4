#include "measurement/contour_from_mask.h"

#ifdef __AVX2__
#include <immintrin.h>
#endif

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

constexpr std::size_t word_pixels = 64;

// One bit for each of 64 pixels that is set, the first one lowest.
#ifdef __AVX2__
std::uint64_t bits_of(const std::uint8_t* at) {
  const auto half = [](const std::uint8_t* pixels) {
    const __m256i values = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(pixels));
    return ~static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(values, _mm256_setzero_si256())));
  };
  __builtin_prefetch(at + 160 * word_pixels);  // what the branches below keep the processor from asking for in time
  return half(at) | std::uint64_t{half(at + word_pixels / 2)} << word_pixels / 2;
}
#else
std::uint64_t bits_of(const std::uint8_t* at) {
  constexpr std::uint64_t low_bits = 0x0101010101010101, all_but_high = 0x7f7f7f7f7f7f7f7f;
  constexpr std::uint64_t gather = 0x0102040810204080;        // moves the low bits of eight bytes into the highest one
  static_assert(std::endian::native == std::endian::little);  // the first of eight pixels is the lowest byte
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < word_pixels; i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, at + i, sizeof eight);
    const std::uint64_t set = (((eight & all_but_high) + all_but_high) | eight) >> 7;
    bits |= ((set & low_bits) * gather >> 56) << i;
  }
  return bits;
}
#endif

// Of the pixels of a row from `at` on; those behind its end are not set.
std::uint64_t bits_in(std::span<const std::uint8_t> row, std::size_t at) {
  const std::size_t rest = row.size() - at;
  if (rest >= word_pixels) return bits_of(row.data() + at);
  if (row.size() >= word_pixels) return bits_of(row.data() + row.size() - word_pixels) >> (word_pixels - rest);
  std::array<std::uint8_t, word_pixels> word{};
  std::ranges::copy(row, word.begin());
  return bits_of(word.data());
}

}  // namespace

// A run begins and ends where a pixel differs from the one before.
void ContourFinder::find_runs(const Mask& mask) {
  runs_.clear();
  const auto width = mask.size.width;
  for (std::size_t row = 0; row < mask.size.height; ++row) {
    const auto pixels = mask.pixels.subspan(row * width, width);
    std::uint64_t before = 0;  // the last pixel
    std::size_t first = 0;
    const auto add_until = [&](std::size_t end) {
      runs_.push_back({static_cast<std::int32_t>(row), static_cast<std::int32_t>(first), static_cast<std::int32_t>(end),
                       static_cast<std::int32_t>(runs_.size())});
    };
    for (std::size_t at = 0; at < width; at += word_pixels) {
      const std::uint64_t bits = bits_in(pixels, at);
      std::uint64_t changes = bits ^ (bits << 1 | before);
      before = bits >> (word_pixels - 1);
      for (; changes != 0; changes &= changes - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(changes));
        if (bits >> bit & 1)
          first = at + bit;
        else
          add_until(at + bit);
      }
    }
    if (before != 0) add_until(width);
  }
}

std::int32_t ContourFinder::group_of(std::int32_t run) {
  for (std::int32_t parent = runs_[run].parent; parent != run; parent = runs_[run].parent)
    run = runs_[run].parent = runs_[parent].parent;
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
      const std::int32_t one = group_of(static_cast<std::int32_t>(k));
      if (runs_[i].parent == static_cast<std::int32_t>(i)) {  // as nearly always: its first neighbour
        runs_[i].parent = one;
        continue;
      }
      const std::int32_t two = group_of(static_cast<std::int32_t>(i));
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

void ContourFinder::reserve(const ImageSize& largest) {
  runs_.reserve(largest.height * ((largest.width + 1) / 2));
  framed_.reserve((largest.width + 2) * (largest.height + 2));
  contour_.reserve(most_outline_points(largest));
  other_.reserve(most_outline_points(largest));
}

const PixelContour& ContourFinder::contour_of(const Mask& mask) {
  contour_.clear();
  groups_ = 0;
  find_runs(mask);
  if (runs_.empty()) return contour_;
  connect_runs();
  copy_with_margin();
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (runs_[i].parent != static_cast<std::int32_t>(i)) continue;
    ++groups_;
    follow(runs_[i], other_);
    if (other_.size() > contour_.size()) std::swap(contour_, other_);
  }
  return contour_;
}

}  // namespace rheocyte
