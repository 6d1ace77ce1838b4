// A file that is written whole or not at all.
#pragma once
#include <filesystem>
#include <string_view>

namespace rheocyte {

/// A file that does not stand in its place yet. It is written under a hidden name beside that place, which nobody can
/// foresee; what is not published leaves no trace.
class WholeFile {
 public:
  /// Makes the empty file. UserError.
  explicit WholeFile(const std::filesystem::path& wanted);
  ~WholeFile();
  WholeFile(WholeFile&& other) noexcept;
  WholeFile& operator=(WholeFile&&) = delete;

  /// Where to write now.
  const std::filesystem::path& scratch() const { return scratch_; }
  /// Brings the content to the disk and puts the file in its place in one step. UserError; an older file is then left
  /// as it was.
  void publish();

 private:
  std::filesystem::path wanted_, scratch_;
};

/// Writes `content` in the same way. Returns 0 or the number of the error (errno).
int write_whole_file(const std::filesystem::path& wanted, std::string_view content);

/// Writes a file into a folder that is published as a whole. Returns 0 or errno.
int write_part(const std::filesystem::path& file, std::string_view content);

/// A hidden name in the same folder that nobody can foresee: ".NAME.rheocyte-1f0c97aa52de".
std::filesystem::path scratch_beside(const std::filesystem::path& wanted);
/// The place for which a hidden name was made; of another path the path itself.
std::filesystem::path place_of(const std::filesystem::path& scratch);

/// A file or a folder. Returns 0 or errno.
int bring_to_disk(const std::filesystem::path& path);

}  // namespace rheocyte
