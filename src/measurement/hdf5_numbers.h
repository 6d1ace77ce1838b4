// Datasets of numbers: their shapes, and their rows converted to what is requested.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measurement/hdf5_handle.h"

namespace rheocyte {

/// Numbers along the dimensions of a dataset, e.g. (events, height, width).
struct DatasetShape {
  std::vector<std::size_t> extent;
  std::size_t rows_per_chunk = 0;  ///< 0 if the data lie in one piece
  bool single_precision = false;   ///< stored as 32-bit floating point
  std::size_t rows() const { return extent.empty() ? 0 : extent[0]; }
  /// Numbers in a row.
  std::size_t width() const;
  /// Whether each row is a picture that is not empty, nor larger than those of the field.
  bool is_pictures() const;
};

/// Told after each piece that was read, so that slow drives are seen to answer.
using PieceRead = std::function<void()>;

/// A dataset that is read in pieces.
struct OpenDataset {
  Hdf5Handle dataset;
  DatasetShape shape;
  mutable std::vector<bool> sound = {};  ///< of each row of chunks: known to be there and under its checksums
};

/// A dataset of numbers (integers, floats, truth values) below `parent`; nothing if it is absent, holds something else,
/// keeps its data outside the file, or claims more data than a file of `file_bytes` can hold.
std::optional<OpenDataset> open_numbers(hid_t parent, const std::string& name, std::uintmax_t file_bytes);

/// Rows [first, first + rows) of a dataset of any number of dimensions, converted, in pieces of about 1 MiB; false if
/// they cannot be read, or were never written. The span holds rows times the product of the other extents.
bool read_rows(const OpenDataset&, std::size_t first, std::span<double> values, const PieceRead& on_piece = {});
bool read_rows(const OpenDataset&, std::size_t first, std::span<std::uint8_t> values, const PieceRead& on_piece = {});
bool read_rows(const OpenDataset&, std::size_t first, std::span<std::int64_t> values, const PieceRead& on_piece = {});

/// The number in an attribute of one element; nothing if it is none.
std::optional<double> number_in(hid_t attribute);

/// Whether the data lie in the file itself: external and virtual storage would let a recording read any other file.
bool lies_in_the_file(hid_t properties);

}  // namespace rheocyte
