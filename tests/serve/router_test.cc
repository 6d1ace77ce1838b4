#include "serve/router.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <nlohmann/json.hpp>

#include "case/user_error.h"
#include "serve/few_at_once.h"
#include "store/system_limit.h"

namespace rheocyte::router_test {
namespace {

Router router() {
  Router r;
  r.add("GET", "/api/items/{item}",
        [](const Request& q) -> Answer { return {.body = std::to_string(q.number("item"))}; });
  r.add("GET", "/api/items/fixed/name", [](const Request&) -> Answer { return {.body = "fixed"}; });
  r.add("POST", "/api/object", [](const Request& q) -> Answer { return {.body = std::to_string(q.json().size())}; });
  r.add("POST", "/api/memory", [](const Request&) -> Answer { throw std::bad_alloc(); });
  r.add("POST", "/api/limit", [](const Request&) -> Answer { throw SystemLimit("threads", EAGAIN); });
  r.add("POST", "/api/user", [](const Request&) -> Answer { throw UserError("a sentence"); });
  r.add(
      "POST", "/api/bug", [](const Request&) -> Answer { throw std::logic_error("oops"); }, 5);
  return r;
}

Answer answer(std::string method, std::string path) {
  return router().answer({.method = std::move(method), .path = std::move(path)});
}

TEST(Router, PartsInBracesAreFound) {
  EXPECT_EQ(answer("GET", "/api/items/12").body, "12");
  EXPECT_EQ(answer("GET", "/api/items/fixed/name").body, "fixed");
  for (const char* number : {"x", "-1", "1x", " 1", "99999999999999999999999", "1.5"})
    EXPECT_EQ(answer("GET", std::string("/api/items/") + number).status, 404) << number;
}

TEST(Router, UnknownPathsAndMethodsHaveTheirAnswers) {
  for (const char* path : {"", "/", "/api", "/api/items", "/api/items/", "/api/items/1/", "//api/items/1"})
    EXPECT_EQ(answer("GET", path).status, 404) << path;
  EXPECT_EQ(answer("DELETE", "/api/items/1").status, 405);
}

TEST(Router, WhatIsThrownBecomesAnAnswer) {
  EXPECT_EQ(answer("POST", "/api/user").status, 400);
  EXPECT_EQ(answer("POST", "/api/user").body, R"({"error":"a sentence","reason":"input"})");
  EXPECT_EQ(answer("POST", "/api/bug").status, 500);
}

TEST(Router, SentencesToTheUserAreInTheWordsOfThePage) {
  Router router([](const std::string& sentence) { return "in words: " + sentence; });
  router.add("GET", "/api/user", [](const Request&) -> Answer { throw UserError("a sentence"); });
  EXPECT_EQ(router.answer({.method = "GET", .path = "/api/user"}).body,
            R"({"error":"in words: a sentence","reason":"input"})");
}

TEST(Router, WhatTheSystemDoesNotGiveIsNoFaultOfTheRequest) {
  const Answer refused = answer("POST", "/api/limit");
  EXPECT_EQ(refused.status, 503);
  EXPECT_NE(refused.body.find("gives no more threads"), std::string::npos) << refused.body;
  const Answer without_memory = answer("POST", "/api/memory");
  EXPECT_EQ(without_memory.status, 503);
  EXPECT_NE(without_memory.body.find(memory_does_not_suffice), std::string::npos) << without_memory.body;
}

TEST(Router, OfWorkThatTakesLongOnlyAFewAreUnderWay) {
  FewAtOnce few(2, "There are two already.");
  Router router;
  router.add("GET", "/long", [&few](const Request&) -> Answer {
    const FewAtOnce::Turn turn = few.begin();
    return {};
  });
  const auto ask = [&] { return router.answer({.method = "GET", .path = "/long"}); };
  EXPECT_EQ(ask().status, 200);
  const FewAtOnce::Turn first = few.begin();
  EXPECT_EQ(ask().status, 200);
  FewAtOnce::Turn second = few.begin();
  EXPECT_EQ(ask().status, 503);
  EXPECT_EQ(ask().status, 503) << "who is refused takes no place";
  second.reset();
  EXPECT_EQ(ask().status, 200);
}

TEST(Router, ObjectsWithVeryManyKeysAreRefused) {
  // Each key of nlohmann's ordered objects is compared with all before it.
  const auto object_of = [](int keys) {
    std::string text = "{";
    for (int i = 0; i < keys; ++i) text += (i ? ",\"" : "\"") + std::to_string(i) + "\":0";
    return text + "}";
  };
  const auto ask = [&](int keys) {
    return router().answer({.method = "POST", .path = "/api/object", .body = object_of(keys)});
  };
  EXPECT_EQ(ask(2000).body, "2000");
  EXPECT_EQ(ask(2001).status, 400);
  const std::string nested = R"({"a": {"b": 1}, "c": )" + object_of(2001) + "}";
  EXPECT_EQ(router().answer({.method = "POST", .path = "/api/object", .body = nested}).status, 400);
}

TEST(Router, BodiesHaveTheLimitOfTheirRoute) {
  EXPECT_EQ(router().body_limit("GET", "/api/items/1"), 0u);
  EXPECT_EQ(router().body_limit("POST", "/api/bug"), 5u);
  EXPECT_EQ(router().body_limit("POST", "/api/user"), usual_body_limit);
  EXPECT_FALSE(router().body_limit("POST", "/api/nothing"));
}

}  // namespace
}  // namespace rheocyte::router_test
