#include "measurement/contour_from_mask.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace rheocyte {

namespace {

// The eight neighbours in the order of the compass, against the clock as seen in the picture: E, NE, N, NW, W, ...
constexpr std::array<std::int32_t, 8> step_x{1, 1, 0, -1, -1, -1, 0, 1};
constexpr std::array<std::int32_t, 8> step_y{0, -1, -1, -1, 0, 1, 1, 1};
constexpr int west = 4;

// The first place from `at` on whose pixel is set (or not); eight pixels at a time while they are all empty.
std::int32_t next_set(const std::uint8_t* row, std::int32_t at, std::int32_t width) {
  for (; at + 8 <= width; at += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, row + at, sizeof eight);
    if (eight != 0) break;
  }
  while (at < width && row[at] == 0) ++at;
  return at;
}

std::int32_t next_empty(const std::uint8_t* row, std::int32_t at, std::int32_t width) {
  while (at < width && row[at] != 0) ++at;
  return at;
}

}  // namespace

void ContourFinder::find_runs(const Mask& mask) {
  runs_.clear();
  const auto width = static_cast<std::int32_t>(mask.size.width);
  for (std::size_t y = 0; y < mask.size.height; ++y) {
    const std::uint8_t* row = mask.pixels.data() + y * mask.size.width;
    for (std::int32_t x = next_set(row, 0, width); x < width;) {
      const std::int32_t end = next_empty(row, x, width);
      runs_.push_back({static_cast<std::int32_t>(y), x, end, static_cast<std::int32_t>(runs_.size())});
      x = next_set(row, end, width);
    }
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

void ContourFinder::copy_with_margin(const Mask& mask) {
  const auto width = static_cast<std::int32_t>(mask.size.width), height = static_cast<std::int32_t>(mask.size.height);
  stride_ = width + 2;
  framed_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2), 0);
  for (const Run& run : runs_)
    std::memset(framed_.data() + static_cast<std::ptrdiff_t>(run.row + 1) * stride_ + run.first + 1, 1,
                static_cast<std::size_t>(run.end - run.first));
}

// Border following: from each pixel the neighbours are searched against the clock, from the one after that from which
// the walk came. The start's left neighbour is empty, so the walk is that of the outer border.
void ContourFinder::follow(const Run& start, PixelContour& contour) const {
  contour.clear();
  std::array<std::ptrdiff_t, 8> offset{};
  for (int d = 0; d < 8; ++d) offset[d] = step_y[d] * static_cast<std::ptrdiff_t>(stride_) + step_x[d];
  const std::uint8_t* const first =
      framed_.data() + static_cast<std::ptrdiff_t>(start.row + 1) * stride_ + start.first + 1;
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
  copy_with_margin(mask);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (runs_[i].parent != static_cast<std::int32_t>(i)) continue;
    follow(runs_[i], other_);
    if (other_.size() > contour_.size()) std::swap(contour_, other_);
  }
  return contour_;
}

}  // namespace rheocyte
