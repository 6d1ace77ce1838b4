#include "serve/assets.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace rheocyte::assets_test {
namespace {

namespace fs = std::filesystem;

class Page : public testing::Test {
 protected:
  Page() {
    std::string pattern = (fs::temp_directory_path() / "rheocyte-page-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    write("index.html", "<!doctype html>");
    write("app.js", "let a = 1;");
    write("app.js.gz", "compressed");
    write("secret.cc", "no part of a page");
  }
  ~Page() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& content) const { std::ofstream(folder_ / name) << content; }

  fs::path folder_;
};

std::string header(const Answer& answer, const std::string& name) {
  for (const auto& [key, value] : answer.headers)
    if (key == name) return value;
  return {};
}

TEST_F(Page, FilesComeCompressedForThoseWhoTakeThat) {
  const Assets assets(folder_);
  EXPECT_EQ(assets.answer("/", true, "").body, "<!doctype html>");
  EXPECT_EQ(assets.answer("/app.js", false, "").body, "let a = 1;");
  const Answer compressed = assets.answer("/app.js", true, "");
  EXPECT_EQ(compressed.body, "compressed");
  EXPECT_EQ(header(compressed, "Content-Encoding"), "gzip");
}

TEST_F(Page, WhoHasAFileIsToldSo) {
  const Assets assets(folder_);
  const std::string tag = header(assets.answer("/app.js", true, ""), "ETag");
  EXPECT_EQ(assets.answer("/app.js", true, tag).status, 304);
  EXPECT_TRUE(assets.answer("/app.js", true, tag).body.empty());
  EXPECT_EQ(assets.answer("/app.js", true, "\"other\"").status, 200);
}

TEST_F(Page, NothingElseIsServed) {
  // What was there when the server began, by its own name alone.
  const Assets assets(folder_);
  write("later.js", "");
  for (const char* path : {"/secret.cc", "/app.js.gz", "/later.js", "/../index.html", "//index.html", "/./app.js", ""})
    EXPECT_FALSE(assets.has(path)) << path;
}

TEST_F(Page, WithoutAPageTheAnswerSaysHowToBuildIt) {
  const Assets assets(folder_ / "missing");
  EXPECT_EQ(assets.answer("/", true, "").status, 503);
  EXPECT_NE(assets.answer("/", true, "").body.find("npm run build"), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::assets_test
