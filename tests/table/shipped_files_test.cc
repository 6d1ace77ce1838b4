// The tables that come with the program are as the program writes them.
#include <gtest/gtest.h>

#include <filesystem>

#include "../refusal.h"
#include "store/read_file.h"
#include "table/rewritten_table.h"

namespace rheocyte::shipped_files_test {
namespace {

namespace fs = std::filesystem;

TEST(ShippedFiles, AreThoseThatTheProgramWrites) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(TABLES)) {
    if (entry.path().extension() != ".cbor") continue;
    const std::string bytes = content_of_file(entry.path(), std::size_t{64} << 20U);
    EXPECT_TRUE(rewritten_table(bytes, entry.path().filename().string()) == bytes)
        << entry.path() << ": bench/rewrite_tables writes it again";
    ++files;
  }
  EXPECT_GE(files, 17);
}

TEST(ShippedFiles, WhoseNamesSayNothingAreRefused) {
  EXPECT_NE(test::refusal_of([] { rewritten_table("", "table.cbor"); }).find("table.cbor: the name does not say"),
            std::string::npos);
}

}  // namespace
}  // namespace rheocyte::shipped_files_test
