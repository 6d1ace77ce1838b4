// A recording that holds results for the events of another one and refers to it for everything else.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "measurement/recording.h"

namespace rheocyte {

/// Written so that the field's programs accept it: the metadata of the original, new features, a log, and a basin that
/// leads to the original. The original is not touched.
class CompanionFile {
 public:
  /// Makes the file and copies the metadata; `program` (name and version) is appended to setup:software version.
  /// Metadata that those programs cannot open, and moduli's settings of other programs, are left out. UserError.
  CompanionFile(const std::filesystem::path& file, const Recording& original, const std::string& program);
  ~CompanionFile();
  CompanionFile(const CompanionFile&) = delete;
  CompanionFile& operator=(const CompanionFile&) = delete;

  /// Free metadata, below "user:".
  void add_user_metadata(const std::string& key, const std::string& text);

  /// Declares a feature with one number per event, in single precision; their number is that of the original's events.
  void add_feature(const std::string& feature);

  /// Declares a feature whose values are those of the original. Where they can be, they are copied as they are stored
  /// when the file is closed, and those that are written before then only tell their extremes. Else they are written,
  /// in double precision if the original has them.
  void add_feature_of(const Recording& original, const std::string& feature);

  /// Values of events [first, first + values.size()) of a declared feature. UserError, e.g. if the disk is full.
  void write(const std::string& feature, std::size_t first, std::span<const double> values);

  /// A log of the given name; lines longer than the field's programs want are broken.
  void add_log(const std::string& name, const std::vector<std::string>& lines);

  /// Refers to the original; relative paths are seen from the folder in which the companion will lie.
  void add_basin(const std::vector<std::string>& paths);

  /// Completes the file and brings it to the disk. UserError.
  void close();

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// Whether a recording has a log of this name, as companions have.
bool has_log(const Recording& recording, const std::string& name);

}  // namespace rheocyte
