// The shapes of a recording's cells from their contours or masks, event by event.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "measurement/contour_from_mask.h"
#include "measurement/recording.h"
#include "shape/outline_shape.h"
#include "store/work_in_turn.h"

namespace rheocyte {

inline constexpr std::size_t fewest_outline_points = 12;  ///< of an outline that is a cell

class EventOutlines {
 public:
  /// The recording, which must outlive it, has contours or masks (asserted): see ShapeSource::has_outlines().
  EventOutlines(const Recording& recording, double pixel_um);

  /// NaN where there is no cell, or no whole one. UserError if the data are damaged.
  ShapeVector features(std::size_t event);
  /// Whether the edge of the picture cuts the cell off. UserError if the data are damaged.
  bool is_cut(std::size_t event) { return is_cut(contour_at_hand(event)); }
  bool is_cut(const PixelContour& contour) const;
  /// Empty where there is no cell. UserError if the data are damaged.
  PixelContour outline(std::size_t event);
  /// work(event, contour) for each of these events in their order, with what outline() returns: in another thread,
  /// while the next ones are read. Returns when all is done. UserError if the data are damaged; what `work` throws.
  void each(std::size_t first, std::size_t count,
            const std::function<void(std::size_t event, const PixelContour&)>& work);
  /// The size of the pictures; 0 x 0 if unknown.
  const ImageSize& picture() const { return picture_; }
  std::size_t events() const { return recording_.events(); }
  double pixel_um() const { return pixel_um_; }

 private:
  /// Of some events in a row as the file holds them.
  struct Stored {
    std::size_t first = 0, count = 0;
    std::vector<PixelContour> contours;  ///< if the recording has some
    std::vector<std::uint8_t> pixels;    ///< else of the masks

    bool has(std::size_t event) const { return event >= first && event < first + count; }
  };
  /// `stored` keeps its memory.
  void read(std::size_t first, std::size_t count, Stored& stored) const;
  /// Valid until the next call.
  const PixelContour& contour(const Stored& stored, std::size_t event);
  const PixelContour& contour_at_hand(std::size_t event);

  const Recording& recording_;
  double pixel_um_;
  bool are_contours_;
  ImageSize picture_;
  std::size_t block_ = 1;  ///< events whose masks are read in one go
  Stored at_hand_;
  std::array<Stored, WorkInTurn::most_waiting + 2> in_turn_;  ///< read, being worked on, and waiting
  ContourFinder finder_;
};

}  // namespace rheocyte
