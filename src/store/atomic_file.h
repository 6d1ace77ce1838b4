// A file that is written whole or not at all.
#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

#include "store/scratch.h"

namespace rheocyte {

/// A file that does not stand in its place yet. It is written under a hidden name beside that place, which no one can
/// foresee; what is not published leaves no trace, and what a killed process leaves is removed by the next one.
class AtomicFile {
 public:
  /// Makes the empty file. `check` throws if what stands in the place must not be replaced; it is asked now and when
  /// the file is published. UserError.
  explicit AtomicFile(const std::filesystem::path& wanted, std::function<void()> check = {});
  ~AtomicFile();
  AtomicFile(AtomicFile&&) noexcept = default;
  AtomicFile& operator=(AtomicFile&&) = delete;

  /// Where to write now.
  const std::filesystem::path& scratch() const { return scratch_.path; }
  /// UserError if what stands in the place must not be replaced.
  void check() const;
  /// Brings the content to the disk and puts the file in its place in one step. UserError; an older file is then left
  /// as it was.
  void publish();

 private:
  std::filesystem::path wanted_;
  std::function<void()> check_;
  Scratch scratch_;
};

/// Writes `content` in the same way. Returns 0 or the number of the error (errno).
int write_atomically(const std::filesystem::path& wanted, std::string_view content);

/// Writes a file into a folder that is published as a whole. Returns 0 or errno.
int write_part(const std::filesystem::path& file, std::string_view content);

/// What becomes of a file that stands in the requested place: kept, the call fails with EEXIST.
enum class Older { replace, keep };

/// Brings a file that was written under another name of the same folder to the disk and puts it in its place in one
/// step. Returns 0 or errno.
int publish_file(const std::filesystem::path& scratch, const std::filesystem::path& wanted, Older);

}  // namespace rheocyte
