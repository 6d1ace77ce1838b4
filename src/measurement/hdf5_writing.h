// What all written recordings share: attributes, lines of text, compressed data with their extremes.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "measurement/written_file.h"

namespace rheocyte {

inline constexpr std::size_t longest_log_line = 100;  ///< bytes; the field's checker complains about longer ones
inline constexpr std::size_t written_chunk_bytes = 1 << 20;

/// Attributes of an object; false if that fails.
bool write_attribute(hid_t object, const std::string& name, hid_t type, const void* value);
bool write_text(hid_t object, const std::string& name, const std::string& text);

/// A dataset of texts of fixed length, at least longest_log_line, with the groups above it; false if that fails.
bool write_lines(WrittenFile& file, const std::string& path, const std::vector<std::string>& lines);

/// The lines, broken where they are longer than longest_log_line.
std::vector<std::string> broken_lines(const std::vector<std::string>& lines);

/// Creation properties of a dataset in chunks: Zstandard, then fletcher32, no time stamps.
Hdf5Handle compressed(std::span<const hsize_t> chunk);

/// Whether a dataset is compressed and checked at least as `compressed` does it.
bool is_compressed(hid_t dataset);

/// Least, greatest and mean of the finite values, as the field's programs keep them with each feature.
struct Extremes {
  double least = std::numeric_limits<double>::infinity(), greatest = -least, sum = 0;
  std::size_t count = 0;
  void add(std::span<const double> values);
};

/// Attributes min, max, mean of a dataset, the first two as precise as its values; none if no value was finite. False
/// if that fails.
bool write_extremes(hid_t dataset, const Extremes&);

}  // namespace rheocyte
