// The files of one result in a folder in which others may stand, too.
#pragma once
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "store/atomic_file.h"

namespace rheocyte {

/// Nothing of them is in its place before all of them are whole: where one cannot be written, those of an older result
/// stay as they were.
class ResultFiles {
 public:
  /// Makes an empty file for a place and returns where to write it now; `check` as AtomicFile has it. All places lie in
  /// one folder. UserError.
  std::filesystem::path add(const std::filesystem::path& place, std::function<void()> check);
  /// A text in the place of nothing or of a file that begins with `mark`. UserError.
  void add_text(const std::filesystem::path& place, std::string_view content, std::string_view mark);

  /// Brings all to the disk and puts one after the other in its place; of two calls for one folder, the second waits.
  /// UserError: a file cannot be written, or what others have put in a place meanwhile must not be replaced; then
  /// nothing is.
  void publish();

 private:
  std::vector<std::filesystem::path> places_;
  std::vector<AtomicFile> files_;
};

/// Writes what will stand in a place where it is to be written now. UserError.
void write_for(const std::filesystem::path& place, const std::filesystem::path& scratch, std::string_view content);

}  // namespace rheocyte
