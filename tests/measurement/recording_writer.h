// Writes small recordings of every kind for tests.
#pragma once
#include <hdf5.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rheocyte::test {

/// How a dataset is stored.
struct Storage {
  enum class Filter { none, gzip, szip, zstd };
  Filter filter = Filter::none;
  bool checksum = false;       ///< fletcher32
  hsize_t rows_per_chunk = 0;  ///< 0: in one piece, without filters
};

/// A new file; every call adds to it. Ends the test program if HDF5 refuses.
class RecordingWriter {
 public:
  explicit RecordingWriter(const std::filesystem::path& file);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Attributes at the root, in the types that different programs use.
  void number(const std::string& key, double value);
  void integer(const std::string& key, int value);
  void truth(const std::string& key, bool value);                     ///< h5py's enumeration
  void text(const std::string& key, const std::string& value);        ///< variable length, UTF-8
  void fixed_text(const std::string& key, const std::string& value);  ///< fixed length
  void polygon(const std::string& key, const std::vector<double>& xy);

  /// One number per event below `group`, stored as `type`, e.g. H5T_IEEE_F32LE.
  void scalar(const std::string& feature, const std::vector<double>& values, hid_t type = H5T_IEEE_F64LE,
              const Storage& storage = {}, const std::string& group = "events");
  /// (events, height, width) of bytes.
  void images(const std::string& feature, const std::vector<std::uint8_t>& pixels, hsize_t height, hsize_t width,
              const Storage& storage = {}, const std::string& group = "events");
  /// The table of a feature's cropped pictures (part, row, y, x, next event of the frame), below /basin_events, and the
  /// feature with their background, if any; the parts are images of the group "basin_events/FEATURE".
  void index_of_cropped(const std::string& feature, const std::vector<int>& table, const std::string& background);
  /// The contour of the next event, x and y in turn.
  void contour(const std::vector<int>& xy, hid_t type = H5T_STD_U16LE);
  /// Lines of a text of fixed length, e.g. /basins/x or /logs/x.
  void lines(const std::string& path, const std::vector<std::string>& lines);

  hid_t root() const { return file_; }

 private:
  void attribute(hid_t object, const std::string& key, hid_t type, const void* value);
  void text_at(hid_t object, const std::string& key, const std::string& value);
  hid_t file_ = -1;
  int contours_ = 0;
};

/// The metadata that every program needs: 20 um, 0.04 ul/s, 0.34 um, CellCarrier, 23 degC, channel.
void write_usual_metadata(RecordingWriter& writer);

/// A folder that is removed with the object.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace rheocyte::test
