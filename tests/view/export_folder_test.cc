#include "view/export_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "../refusal.h"

namespace rheocyte::export_folder_test {
namespace {

namespace fs = std::filesystem;

TEST(ExportFolder, OneThatCannotBeMadeIsOneSentence) {
  std::string pattern = (fs::temp_directory_path() / "rheocyte-export-XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  std::ofstream(folder / "app.js") << "let a = 1;";
  const std::string sentence =
      test::refusal_of([&] { const ExportFolder below_a_file(folder / "app.js" / "exports"); });
  fs::remove_all(folder);
  EXPECT_NE(sentence.find("nothing can be written into"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("--output"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace rheocyte::export_folder_test
