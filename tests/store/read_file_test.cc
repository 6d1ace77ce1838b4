// Reading a file never waits for somebody to write it, and never takes more than is wanted.
#include "store/read_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "case/user_error.h"
#include "store/own_file.h"

namespace rheocyte::read_file_test {
namespace {

namespace fs = std::filesystem;

class ReadFile : public testing::Test {
 protected:
  ReadFile() {
    std::string pattern = (fs::temp_directory_path() / "rheocyte-read-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~ReadFile() override { fs::remove_all(folder_); }

  std::string refusal(const fs::path& path, std::size_t most) const {
    try {
      static_cast<void>(content_of_file(path, most));
    } catch (const UserError& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
};

TEST_F(ReadFile, APipeIsNotWaitedFor) {
  const fs::path pipe = folder_ / "grid_pipe.cbor";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(first_bytes(pipe, 10));
  EXPECT_NE(refusal(pipe, 10).find("is not a regular file"), std::string::npos);
  EXPECT_THROW(check_replaceable(pipe, "# mark", Foreign::keep), UserError);
}

TEST_F(ReadFile, OfAFileWithoutEndOnlyItsBeginningIsRead) {
  const fs::path large = folder_ / "large";
  std::ofstream(large) << "first";
  fs::resize_file(large, std::uintmax_t{1} << 40U);  // holds nothing on the disk
  EXPECT_EQ(first_bytes(large, 5), "first");
  EXPECT_NE(refusal(large, std::size_t{1} << 20U).find("larger than the 1 MB"), std::string::npos);
}

TEST_F(ReadFile, AllOfASoundFileIsGiven) {
  std::ofstream(folder_ / "file") << "content";
  EXPECT_EQ(content_of_file(folder_ / "file", 7), "content");
  EXPECT_EQ(first_bytes(folder_ / "file", 100), "content");
  EXPECT_FALSE(first_bytes(folder_ / "none", 100));
  EXPECT_NE(refusal(folder_ / "none", 7).find("cannot be read"), std::string::npos);
  EXPECT_NE(refusal(folder_, 7).find("is not a regular file"), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::read_file_test
