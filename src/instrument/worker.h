// What one thread needs to go from masks, contours or features to moduli, cell after cell: all memory is taken when it
// is opened.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "instrument/recent_cells.h"
#include "instrument/set_up.h"
#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"

namespace rheocyte {

class Worker {
 public:
  static constexpr std::size_t most_pixels = std::size_t{1} << 22U;
  static constexpr std::uint32_t fewest_remembered = 20, usually_remembered = 4096, most_remembered = 1U << 20U;

  /// For pictures of at most this size, which has pixels, at most `most_pixels`; remembers so many cells.
  Worker(SetUp& set_up, const ImageSize& largest, std::size_t remembered);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Any thread.
  /// Takes this set-up at its next cell.
  void use(SetUp& set_up);
  const RecentCells& recent() const { return recent_; }
  rheocyte_cell_counts counts() const;

  // The worker's thread: RHEOCYTE_CELL_OK, or why there are no results.
  std::int32_t from_masks(const rheocyte_cell_masks& masks, std::span<rheocyte_cell_result> results);
  /// `picture` 0 x 0: unknown.
  std::int32_t from_contour(std::span<const PixelPoint> contour, const ImageSize& picture,
                            rheocyte_cell_result& result);
  /// Without inertia ratios if `inertia_ratio` is empty.
  void from_features(std::span<const double> area_um2, std::span<const double> deformation,
                     std::span<const double> inertia_ratio, std::span<rheocyte_cell_result> results);

 private:
  using Count = std::atomic<std::uint64_t>;

  const SetUp& current();
  bool fits(const ImageSize& picture) const;
  /// The pixels of a mask without gaps between its rows, one byte for each.
  Mask plain(const rheocyte_cell_masks& masks, std::size_t row_bytes, const std::uint8_t* pixels);
  void measure(const SetUp& set_up, std::span<const PixelPoint> contour, const ImageSize& picture,
               rheocyte_cell_result& result);
  void remember(const rheocyte_cell_result& result);

  SetUp* set_up_;
  std::atomic<SetUp*> next_ = nullptr;  ///< null: the same
  ImageSize largest_;
  ContourFinder finder_;
  ContourMeasurer measurer_;
  std::vector<std::uint8_t> pixels_;
  RecentCells recent_;
  Count cells_ = 0;
  std::array<Count, RHEOCYTE_CELL_STATES> young_{}, effective_{};
};

}  // namespace rheocyte
