#include "store/file_writer.h"

#include <fmt/format.h>

#include <cerrno>
#include <utility>

#include "case/refuse_path.h"
#include "store/atomic_file.h"
#include "store/system_files.h"
#include "store/system_limit.h"

namespace rheocyte {

FileWriter::FileWriter(const std::filesystem::path& file, std::string advice)
    : path_(file), advice_(std::move(advice)), file_(open_stream(file)) {
  if (file_) return;
  check_open_files(errno);
  refuse();
}

FileWriter::~FileWriter() {
  if (file_) std::fclose(file_);
}

void FileWriter::append(std::string_view content) {
  if (content.empty()) return;  // it may have no address
  if (std::fwrite(content.data(), 1, content.size(), file_) != content.size()) refuse();
}

void FileWriter::close() {
  if (std::fclose(std::exchange(file_, nullptr)) != 0) refuse();
}

void FileWriter::refuse() const { refuse_path(place_of(path_), fmt::format("cannot be written; {}", advice_)); }

}  // namespace rheocyte
