// A file that is written piece by piece.
#pragma once
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace rheocyte {

class FileWriter {
 public:
  /// Replaces what is there. `advice` ends the sentence if writing fails. UserError.
  explicit FileWriter(const std::filesystem::path& file,
                      std::string advice = "is the disk full, or is writing there not allowed?");
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// UserError, e.g. if the disk is full.
  void append(std::string_view content);
  /// UserError if not everything could be written.
  void close();

 private:
  [[noreturn]] void refuse() const;

  std::filesystem::path path_;
  std::string advice_;
  std::FILE* file_;
};

}  // namespace rheocyte
