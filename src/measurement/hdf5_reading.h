// Reading whatever types a file holds, within limits that a damaged file cannot lift.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "measurement/hdf5_handle.h"
#include "measurement/metadata.h"

namespace rheocyte {

/// What no file of the field comes near; beyond it a file counts as damaged.
struct ReadingLimits {
  std::size_t names = 10'000'000;        ///< members of a group (one contour per event)
  std::size_t name_length = 256;         ///< bytes
  std::size_t text_length = 1 << 16;     ///< bytes
  std::size_t text_lines = 100'000;      ///< of a log or a basin's definition
  std::size_t chunk_bytes = 1 << 30;     ///< decompressed
  std::size_t image_side = 1 << 14;      ///< pixels
  std::size_t contour_points = 1 << 20;  ///< of one event
  double max_compression = 5e4;          ///< bytes of data per byte of file
  double events_per_byte = 10;           ///< of the file and its basins; true ones have less than 1
};
inline constexpr ReadingLimits reading_limits;

/// Opens an object below `parent`; a handle that tests as false if it is absent, broken or of another kind.
Hdf5Handle open_group(hid_t parent, const std::string& name);
Hdf5Handle open_dataset(hid_t parent, const std::string& name);

/// Names of the members of a group in the order of their names, those longer than the limit left out; nothing if the
/// group is damaged or has too many.
std::optional<std::vector<std::string>> member_names(hid_t group);

/// The lines of a dataset of texts; nothing if it is not one or too large.
std::optional<std::vector<std::string>> read_lines(hid_t dataset, std::uintmax_t file_bytes);

/// Whether the name below `parent` is a link to another file; such links are never followed.
bool leads_to_another_file(hid_t parent, const std::string& name);

/// Every attribute of an object that is one number or text.
Metadata read_attributes(hid_t object);

}  // namespace rheocyte
