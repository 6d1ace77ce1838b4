// What an open recording holds; shared by the files that implement it.
#pragma once
#include <map>

#include "measurement/basin.h"
#include "measurement/cropped_images.h"
#include "measurement/hdf5_numbers.h"
#include "measurement/hdf5_reading.h"
#include "measurement/recording.h"

namespace rheocyte {

using Datasets = std::map<std::string, OpenDataset>;

/// A basin that could be opened: a recording, or datasets of the same file.
struct Recording::Basin {
  std::unique_ptr<Recording> recording;              ///< null for internal ones
  Datasets internal;                                 ///< scalars and pictures
  std::map<std::string, CroppedImages> cropped;      ///< of an internal one
  std::optional<std::vector<std::string>> features;  ///< the only ones it gives
  std::optional<std::vector<std::int64_t>> mapping;  ///< event of the basin for each of our events
};

struct Recording::Content {
  std::filesystem::path path;
  std::uintmax_t bytes = 0, bytes_with_basins = 0;
  PieceRead on_piece;
  std::vector<std::filesystem::path> others;  ///< that contain metadata
  Hdf5Handle file, events_group, contours;
  Metadata metadata;
  Datasets scalars, images;
  std::size_t events = 0;
  std::vector<Basin> basins;
  std::vector<std::string> remarks;
};

}  // namespace rheocyte
