// The folder of a result: whole or not at all. Everything is written into a sibling folder that then takes the place.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "store/scratch.h"

namespace rheocyte {

/// The absolute path without links; makes its parents. UserError if a result cannot be written there: no permission,
/// the parent is a file, or the folder holds something else than a result of rheocyte. Leaves no trace but the parents.
std::filesystem::path check_result_folder(const std::filesystem::path& folder);

/// Hidden folders with checkpoints that killed calls for this folder have left, each with a claim. They are removed
/// once a new result is published.
std::vector<Scratch> interrupted_results(const std::filesystem::path& folder);

/// A result that is being written. Without publish() nothing of it remains.
class ResultFolder {
 public:
  /// Checks as check_result_folder does and makes the sibling folder. UserError.
  explicit ResultFolder(const std::filesystem::path& folder);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Where to write now; each file is complete when publish() is called.
  const std::filesystem::path& scratch() const { return scratch_.path; }

  /// Writes one file. UserError (full disk, quota), naming the file and the reason.
  void write(const std::string& file_name, std::string_view content) const;

  /// Brings all files to the disk and puts the folder in its place in one step; files of the old folder that are not
  /// rheocyte's are kept. UserError; the old folder is then untouched.
  void publish();

 private:
  std::filesystem::path folder_;
  Scratch scratch_;
};

}  // namespace rheocyte
