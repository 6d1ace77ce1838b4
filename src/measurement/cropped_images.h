// Pictures of which a recording keeps only the part around each cell, as dclab's "h5datasetchop" stores them.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measurement/hdf5_numbers.h"
#include "measurement/pixel_contour.h"

namespace rheocyte {

/// The pictures of one feature. Its group holds "0", "1", ...: parts of equal size, and "index", a row for each event:
/// the dataset and the row of its part, the part's place (y, x) in the picture, and the next event of the same frame,
/// in a circle. For images the parts are differences from the background, modulo 256, and 0 away from the cell.
class CroppedImages {
 public:
  /// Opens the group; nothing if its index is missing. `size` is that of the whole pictures.
  static std::optional<CroppedImages> open(Hdf5Handle group, ImageSize size, std::uintmax_t file_bytes);

  ImageSize size() const { return size_; }
  std::size_t events() const { return index_.shape.rows(); }
  /// The feature whose pictures are to be added, modulo 256; empty: none.
  const std::string& background() const { return background_; }
  /// For what is said of damage.
  hid_t dataset() const { return index_.dataset.get(); }

  /// The parts of all events in the frame of this one at their places, 0 around them. False if the data are damaged.
  bool read(std::size_t event, std::span<std::uint8_t> picture, const PieceRead& on_piece) const;

 private:
  struct Row {
    std::int64_t part = 0, row = 0, y = 0, x = 0, next = 0;
  };
  struct Part {
    OpenDataset data;
    std::vector<std::uint8_t> pixels;  ///< of the one that was read last
  };
  bool read_index(const PieceRead& on_piece) const;
  bool place(const Row& row, std::span<std::uint8_t> picture, const PieceRead& on_piece) const;
  Part* part(std::int64_t number) const;

  ImageSize size_;
  std::uintmax_t file_bytes_ = 0;
  std::string background_;
  Hdf5Handle group_;
  OpenDataset index_;
  // Read when they are needed first.
  mutable std::vector<Row> rows_;
  mutable std::vector<std::optional<Part>> parts_;
};

}  // namespace rheocyte
