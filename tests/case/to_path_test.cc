#include "case/to_path.h"

#include <gtest/gtest.h>

namespace rheocyte::to_path_test {

TEST(ToPath, KeepsTheCharactersOfUtf8) {  // as the standard gives them back, on any system
  for (const std::string text : {"M1.rtdc", "Zellen größer ° 細胞.rtdc", "a folder/file", ""}) {
    const std::u8string kept = to_path(text).u8string();
    EXPECT_EQ(std::string(kept.begin(), kept.end()), text);
  }
}

TEST(ToPath, KeepsAllBytesWherePathsAreBytes) {  // names of files need not be UTF-8
  if constexpr (sizeof(std::filesystem::path::value_type) == 1) {
    const std::string latin =
        "gr\xF6\xDF"
        "er";
    EXPECT_EQ(to_path(latin).native().size(), latin.size());
    EXPECT_EQ(to_path(latin).string(), latin);
  }
}

}  // namespace rheocyte::to_path_test
