// A new recording, written event by event.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "measurement/pixel_contour.h"

namespace rheocyte {

/// Written so that the field's programs accept it: types, compression, checksums and attributes are those of their own
/// files. The same calls give the same bytes.
class RecordingFile {
 public:
  /// UserError if the file cannot be made.
  explicit RecordingFile(const std::filesystem::path& file);
  ~RecordingFile();
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  /// Metadata "section:key".
  void add_metadata(const std::string& key, double value);
  void add_metadata(const std::string& key, std::int64_t value);
  void add_metadata(const std::string& key, const std::string& text);

  /// Appends one number per event to a feature, which appears with its first values; "index", "frame" and
  /// maps of basins are stored as the whole numbers that they are. UserError, e.g. if the disk is full.
  void append(const std::string& feature, std::span<const double> values);

  /// Appends pictures, row by row, to "mask" (anything but 0 becomes 255), "image" or another feature of pictures.
  void append_images(const std::string& feature, ImageSize size, std::span<const std::uint8_t> pixels);

  /// A basin: another recording, whose event map[i] is event i; `map` is a feature that is appended, "basinmap0".
  void add_basin(const std::filesystem::path& recording, const std::string& map);

  /// A log of the given name.
  void add_log(const std::string& name, const std::vector<std::string>& lines);

  /// Completes the file, with the number of events, and brings it to the disk. All features must have one length
  /// (asserted). UserError.
  void close();

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace rheocyte
