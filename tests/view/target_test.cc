#include "view/target.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "view/path_text.h"

namespace rheocyte::target_test {
namespace {

TEST(Target, PathAndQueryAreDecoded) {
  const Target target = read_target("/api/items/a%20b+c?x=1%2B1&name=a+b&empty&x=2&=nothing&&y=%zz%4#end");
  EXPECT_EQ(target.path, "/api/items/a b+c");
  const Request::Names wanted{{"x", "2"}, {"name", "a b"}, {"empty", ""}, {"", "nothing"}, {"y", "%zz%4"}};
  EXPECT_EQ(target.query, wanted);
}

TEST(Target, OddOnesAreNoTrouble) {
  for (const char* text : {"", "?", "/?", "#", "%", "/%", "/%4", "/?=", "/?&&&", "/?a=b=c", "*", "http://other/"})
    static_cast<void>(read_target(text));
  EXPECT_EQ(read_target("/?a=b=c").query.at("a"), "b=c");
  EXPECT_EQ(read_target("http://other/path").path, "http://other/path");
}

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
}  // namespace rheocyte::target_test
