#include "serve/access.h"

#include <gtest/gtest.h>

namespace rheocyte::access_test {
namespace {

const Access access("secret", "127.0.0.1", 4711);

Credentials ours() {
  return {.hosts = {"127.0.0.1:4711"},
          .origins = {},
          .authorization = "Bearer secret",
          .cookie = {},
          .local_address = "127.0.0.1"};
}

int status(const Credentials& who) {
  const auto refused = access.refusal_of(who);
  return refused ? refused->status : 200;
}

TEST(Access, TheTokenComesAsBearerOrAsCookie) {
  Credentials who = ours();
  EXPECT_EQ(status(who), 200);
  who.authorization.clear();
  EXPECT_EQ(status(who), 401);
  who.cookie = "a=b; rheocyte_4711=secret; c=d";
  EXPECT_EQ(status(who), 200);
}

TEST(Access, AWrongTokenIsRefused) {
  for (const char* token : {"Bearer ", "Bearer secre", "Bearer secrets", "Basic secret", "secret", ""}) {
    Credentials who = ours();
    who.authorization = token;
    EXPECT_EQ(status(who), 401) << token;
  }
  for (const char* cookie :
       {"rheocyte_4711=", "rheocyte_4712=secret", "xrheocyte_4711=secret", "rheocyte_4711secret"}) {
    Credentials who = ours();
    who.authorization.clear();
    who.cookie = cookie;
    EXPECT_EQ(status(who), 401) << cookie;
  }
}

TEST(Access, AForeignHostOrOriginIsRefusedEvenWithTheToken) {
  for (const char* host : {"evil.example:4711", "127.0.0.1:80", "127.0.0.1", "localhost:4711.evil.example", ""}) {
    Credentials who = ours();
    who.hosts = {host};
    EXPECT_EQ(status(who), 403) << host;
  }
  for (const char* host : {"localhost:4711", "LOCALHOST:4711", "[::1]:4711"}) {
    Credentials who = ours();
    who.hosts = {host};
    EXPECT_EQ(status(who), 200) << host;
  }
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:4711", "http://127.0.0.1:4712"}) {
    Credentials who = ours();
    who.origins = {origin};
    EXPECT_EQ(status(who), 403) << origin;
  }
  Credentials who = ours();
  who.origins = {"http://localhost:4711"};
  EXPECT_EQ(status(who), 200);
  who.hosts = {"127.0.0.1:4711", "evil.example"};
  EXPECT_EQ(status(who), 400);
}

TEST(Access, SigningInSetsACookieThatScriptsDoNotSee) {
  const Answer answer = access.sign_in(ours(), "secret");
  EXPECT_EQ(answer.status, 303);
  const std::pair<std::string, std::string> cookie{"Set-Cookie",
                                                   "rheocyte_4711=secret; HttpOnly; SameSite=Strict; Path=/"};
  EXPECT_NE(std::find(answer.headers.begin(), answer.headers.end(), cookie), answer.headers.end());
  EXPECT_EQ(access.sign_in(ours(), "wrong").status, 401);
  Credentials foreign = ours();
  foreign.hosts = {"evil.example:4711"};
  EXPECT_EQ(access.sign_in(foreign, "secret").status, 403);
}

TEST(Access, TheKeyOfTheStartedBrowserOpensOnceAndOnlyForTheSameUser) {
  // Others read the address with the key in the list of processes.
  Access own("secret", "127.0.0.1", 4711);
  const std::string address = own.address_of_once(), key = address.substr(address.find('=') + 1);
  EXPECT_EQ(address.find("secret"), std::string::npos);
  Credentials browser = ours();
  browser.authorization.clear();
  EXPECT_EQ(own.sign_in_once(browser, key).status, 401) << "the system tells nothing";
  browser.is_of_own_user = [] { return false; };
  EXPECT_EQ(own.sign_in_once(browser, key).status, 401);
  browser.is_of_own_user = [] { return true; };
  EXPECT_EQ(own.sign_in_once(browser, "secret").status, 401);
  EXPECT_EQ(own.sign_in_once(browser, key).status, 303);
  EXPECT_EQ(own.sign_in_once(browser, key).status, 401) << "it has been used";
  browser.cookie = "rheocyte_4711=secret";
  EXPECT_EQ(own.sign_in_once(browser, key).status, 303) << "a browser that asks twice";
  browser.hosts = {"evil.example:4711"};
  EXPECT_EQ(own.sign_in_once(browser, key).status, 403);
}

TEST(Access, TokensAreLongAndDiffer) {
  EXPECT_EQ(new_token().size(), 32u);
  EXPECT_NE(new_token(), new_token());
}

}  // namespace
}  // namespace rheocyte::access_test
