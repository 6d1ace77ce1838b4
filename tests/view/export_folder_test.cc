#include "view/export_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "../refusal.h"
#include "serve/router.h"

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

TEST(ExportFolder, NothingThatItDidNotWriteIsReplaced) {
  // A folder or a file of others in the place of an export, before it begins or at its end: refused, and left alone.
  std::string pattern = (fs::temp_directory_path() / "rheocyte-export-XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  ExportFolder exports(folder);
  const auto refused = [](const auto& action) {
    try {
      action();
      return 0;
    } catch (const Refused& refusal) {
      return refusal.status;
    }
  };
  fs::create_directory(folder / "cell.toml");
  std::ofstream(folder / "own.toml") << "own";
  EXPECT_EQ(refused([&] { exports.write("cell.toml", "case"); }), 409);
  EXPECT_EQ(refused([&] { exports.write("own.toml", "case"); }), 409);
  EXPECT_EQ(refused([&] { exports.claim("own.toml", ExportKind::folder); }), 409);
  {
    ExportPlace late = exports.claim("late.toml");
    EXPECT_EQ(refused([&] { exports.claim("late.toml"); }), 409);
    std::ofstream(late.scratch()) << "case";
    fs::create_directory(folder / "late.toml");
    EXPECT_EQ(refused([&] { late.publish(); }), 409);
  }
  exports.write("mine.toml", "once");
  exports.write("mine.toml", "twice");
  EXPECT_EQ(refused([&] { exports.claim("mine.toml", ExportKind::folder); }), 409);
  std::string left;
  std::ifstream(folder / "own.toml") >> left;
  EXPECT_EQ(left, "own");
  std::ifstream(folder / "mine.toml") >> left;
  EXPECT_EQ(left, "twice");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 4) << "nothing hidden is left";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace rheocyte::export_folder_test
