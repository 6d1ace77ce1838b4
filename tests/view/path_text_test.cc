#include "view/path_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace rheocyte::path_text_test {
namespace {

TEST(PathText, EveryNameComesBackFromItsText) {
  // Among them what no file of UTF-8 has, and the characters that stand for bytes.
  for (const std::string name :
       {"plain.rtdc", "\xC3\xA4.rtdc", "latin \xE4\xF6\xFC.rtdc", "cut \xE2\x82", "\xFF\xFE", "\xED\xA0\x80",
        "\xC0\xAF", "\xE0\x80\x80", "\xF4\x8F\xBE\x80", "\xF4\x8F\xBF\xBF", "\xF4\x90\x80\x80"}) {
    const std::string text = path_text(name);
    EXPECT_EQ(path_of_text(text), name);
    EXPECT_EQ(nlohmann::ordered_json::parse(nlohmann::ordered_json(text).dump()), text);
  }
  EXPECT_EQ(path_text("\xC3\xA4.rtdc"), "\xC3\xA4.rtdc");
}

}  // namespace
}  // namespace rheocyte::path_text_test
