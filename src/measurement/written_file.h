// The HDF5 file of a recording while it is written.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "measurement/hdf5_handle.h"

namespace rheocyte {

/// HDF5 1.14 frees a dataset whose last bytes do not get to the disk when it is closed, and goes on using it when its
/// file is flushed or closed. Its datasets are therefore closed once the whole file has been flushed; where that fails,
/// file and datasets stay as they are until the process ends.
class WrittenFile {
 public:
  /// An empty file in place of what is there. UserError.
  explicit WrittenFile(const std::filesystem::path& path);
  ~WrittenFile();
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;

  hid_t get() const { return file_.get(); }
  /// As H5Dcreate2, with the groups above it; tests as false if that fails. The dataset stays open until the file is
  /// closed.
  Hdf5Handle dataset(const std::string& path, hid_t type, hid_t space, hid_t creation, hid_t access = H5P_DEFAULT);

  /// UserError unless it is good: `what` cannot be written. Nothing more is written then.
  void check(bool good, const std::string& what);
  /// UserError unless everything is on the disk.
  void close();

 private:
  bool close_flushed();
  void leave_open();

  std::filesystem::path path_;
  Hdf5Handle file_;
  std::vector<Hdf5Handle> datasets_;
};

}  // namespace rheocyte
