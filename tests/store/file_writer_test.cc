// Pieces follow one another in the file, and an empty one is written as nothing.
#include "store/file_writer.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace rheocyte::file_writer_test {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(FileWriter, AnEmptyPieceIsWrittenAsNothing) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "file_writer_test.txt";
  FileWriter writer(file);
  writer.append("one ");
  writer.append(std::string_view{});
  writer.append("two");
  writer.close();
  EXPECT_EQ(content_of(file), "one two");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace rheocyte::file_writer_test
