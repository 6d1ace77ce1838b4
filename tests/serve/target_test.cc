#include "serve/target.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace rheocyte::target_test
