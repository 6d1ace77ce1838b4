// The server among clients of all kinds.
#include "serve/http_server.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "../refusal.h"
#include "case/user_error.h"
#include "served.h"

namespace rheocyte::http_server_test {
namespace {

using test::ask;
using test::request_text;
using test::Served;
using test::status_of;
using test::Wire;

Router echo() {
  Router router;
  router.add("GET", "/api/ping", [](const Request&) -> Answer { return {.body = "pong"}; });
  router.add(
      "POST", "/api/echo", [](const Request& q) -> Answer { return {.body = q.body}; }, 1000);
  router.add("GET", "/api/pieces", [](const Request&) -> Answer {
    return {.give_pieces = [](const TakePiece& take) {
      for (const char* piece : {"one\n", "two\n"}) take(piece);
    }};
  });
  router.add("GET", "/api/broken", [](const Request&) -> Answer {
    return {.give_pieces = [](const TakePiece& take) {
      take("one\n");
      throw UserError("The file has vanished.");
    }};
  });
  return router;
}

TEST(HttpServer, AnswersHaveTheHeadersThatKeepOthersOut) {
  const Router router = echo();
  const Served served(router);
  const std::string answer = ask(served, "GET", "/api/ping");
  EXPECT_EQ(status_of(answer), 200);
  EXPECT_EQ(test::body_of(answer), "pong");
  for (const char* header : {"Content-Security-Policy: default-src 'self'", "X-Content-Type-Options: nosniff",
                             "Referrer-Policy: no-referrer"})
    EXPECT_NE(answer.find(header), std::string::npos) << header;
}

TEST(HttpServer, NothingIsAnsweredWithoutToken) {
  const Router router = echo();
  const Served served(router);
  const std::string host = "Host: 127.0.0.1:" + std::to_string(served.port());
  for (const std::string path : {"/", "/api/ping", "/api/nothing", "/app.js", "/?token=wrong"}) {
    const Wire wire(served.port());
    wire.send("GET " + path + " HTTP/1.1\r\n" + host + "\r\nConnection: close\r\n\r\n");
    EXPECT_EQ(status_of(wire.read_to_end()), 401) << path;
  }
}

TEST(HttpServer, AProgramOfTheSameUserSignsInOnceWithoutTheToken) {
  const Router router = echo();
  const Served served(router);
  const std::string request = "GET " + served.first_target() +
                              " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(served.port()) +
                              "\r\nConnection: close\r\n\r\n";
  for (const int status : {303, 401}) {
    const Wire wire(served.port());
    wire.send(request);
    EXPECT_EQ(status_of(wire.read_to_end()), status);
  }
}

TEST(HttpServer, BodiesComeThroughUpToTheirLimit) {
  const Router router = echo();
  const Served served(router);
  EXPECT_EQ(test::body_of(ask(served, "POST", "/api/echo", std::string(1000, 'x'))), std::string(1000, 'x'));
  EXPECT_EQ(status_of(ask(served, "POST", "/api/echo", std::string(1001, 'x'))), 413);
  EXPECT_EQ(status_of(ask(served, "POST", "/api/echo", std::string(3000000, 'x'))), 413);
  EXPECT_EQ(status_of(ask(served, "POST", "/api/nothing", "x")), 404);
  EXPECT_EQ(status_of(ask(served, "POST", "/api/ping", "x")), 405);
}

TEST(HttpServer, AConnectionServesOneRequestAfterAnother) {
  const Router router = echo();
  const Served served(router);
  Wire wire(served.port());
  for (int i = 0; i < 20; ++i) {
    wire.send(request_text(served, "POST", "/api/echo", std::to_string(i), ""));
    EXPECT_EQ(test::body_of(wire.read_answer()), std::to_string(i));
  }
  // Two at once, the second before the first is answered.
  wire.send(request_text(served, "POST", "/api/echo", "a", "") + request_text(served, "POST", "/api/echo", "b", ""));
  EXPECT_EQ(test::body_of(wire.read_answer()), "a");
  EXPECT_EQ(test::body_of(wire.read_answer()), "b");
}

TEST(HttpServer, PiecesArriveAsTheyAreGiven) {
  const Router router = echo();
  const Served served(router);
  const std::string body = test::body_of(ask(served, "GET", "/api/pieces"));
  EXPECT_EQ(body, "4\r\none\n\r\n4\r\ntwo\n\r\n0\r\n\r\n");
}

TEST(HttpServer, WhatFailsBetweenTwoPiecesEndsTheConnectionNotTheServer) {
  const Router router = echo();
  const Served served(router);
  EXPECT_FALSE(ask(served, "GET", "/api/broken").ends_with("0\r\n\r\n"));
  EXPECT_EQ(status_of(ask(served, "GET", "/api/ping")), 200);
}

TEST(HttpServer, AThousandMalformedRequestsDoNotCrashIt) {
  // Random bytes, and good requests with bytes changed, cut short or stuck together.
  const Router router = echo();
  const Served served(router);
  std::mt19937 random(1);
  const std::string good = request_text(served, "POST", "/api/echo", "hello") +
                           request_text(served, "GET", "/api/ping?x=%41&y", {}, "Range: bytes=0-1\r\n");
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = i % 4 == 0 ? std::string(random() % 300, '\0') : good;
    if (i % 4 == 0)
      for (char& byte : bytes) byte = static_cast<char>(random());
    else if (i % 4 == 1)
      for (int k = 0; k < 1 + i % 7; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    else if (i % 4 == 2)
      bytes.resize(random() % bytes.size());
    else
      bytes.insert(random() % bytes.size(), std::string(random() % 20, "\r\n: %0"[random() % 6]));
    Wire wire(served.port());
    wire.send(bytes);
    wire.close();
  }
  EXPECT_EQ(status_of(ask(served, "GET", "/api/ping")), 200);
}

TEST(HttpServer, OddHeadsHaveAnAnswer) {
  const Router router = echo();
  const Served served(router);
  const auto status = [&](const std::string& headers, const std::string& body = "x") {
    const Wire wire(served.port());
    wire.send(request_text(served, "POST", "/api/echo", {}, headers) + body);
    return status_of(wire.read_to_end());
  };
  EXPECT_EQ(status("Transfer-Encoding: chunked\r\n", "1\r\nx\r\n0\r\n\r\n"), 411);
  EXPECT_EQ(status("Content-Length: -1\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 1x\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 99999999999999999999\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 1\r\nContent-Length: 1\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 1\r\nContent-Encoding: gzip\r\n"), 415);
  const Wire wire(served.port());
  wire.send(request_text(served, "GET", "/api/ping?" + std::string(5000, 'x')));
  EXPECT_EQ(status_of(wire.read_to_end()), 414);
  const Wire endless(served.port());
  endless.send("GET /" + std::string(200000, 'x'));
  EXPECT_NE(status_of(endless.read_to_end()), 200);
}

TEST(HttpServer, AHeadAloneIsGivenWhereHeadIsAsked) {
  const Router router = echo();
  const Served served(router);
  const std::string answer = ask(served, "HEAD", "/api/ping");
  EXPECT_EQ(status_of(answer), 200);
  EXPECT_NE(answer.find("Content-Length: 4"), std::string::npos) << answer;
  EXPECT_EQ(test::body_of(answer), "");
  EXPECT_EQ(test::body_of(ask(served, "HEAD", "/api/pieces")), "");
}

TEST(HttpServer, OldClientsGetPiecesWithoutFrames) {
  const Router router = echo();
  const Served served(router);
  const Wire wire(served.port());
  std::string request = request_text(served, "GET", "/api/pieces");
  wire.send(request.replace(request.find("HTTP/1.1"), 8, "HTTP/1.0"));
  EXPECT_EQ(test::body_of(wire.read_to_end()), "one\ntwo\n");
}

TEST(HttpServer, AClientThatWaitsForItMaySendItsBody) {
  const Router router = echo();
  const Served served(router);
  const Wire wire(served.port());
  wire.send(request_text(served, "POST", "/api/echo", {},
                         "Connection: close\r\nExpect: 100-continue\r\nContent-Length: 5\r\n"));
  wire.send("hello");
  const std::string answer = wire.read_to_end();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 100 Continue\r\n\r\nHTTP/1.1 200")) << answer;
  EXPECT_TRUE(answer.ends_with("\r\n\r\nhello")) << answer;
}

TEST(HttpServer, NothingButAccessIsReadOfARequestThatMayNotAsk) {
  // Long lists of ranges ended an earlier server, which took them apart by a recursive expression.
  const Router router = echo();
  const Served served(router);
  std::string ranges = "bytes=0-1";
  while (ranges.size() < 60'000) ranges += ",0-1";
  const std::string host = "Host: 127.0.0.1:" + std::to_string(served.port()) + "\r\n";
  for (const std::string& header : {"Range: " + ranges, std::string("Content-Length: 5"),
                                    std::string("Transfer-Encoding: chunked"), std::string("Content-Encoding: gzip")}) {
    const Wire wire(served.port());
    wire.send("POST /api/echo HTTP/1.1\r\nConnection: close\r\n" + host + header + "\r\n\r\n");
    EXPECT_EQ(status_of(wire.read_to_end()), 401) << header.substr(0, 40);
  }
  const Wire wire(served.port());
  wire.send(request_text(served, "GET", "/api/ping", {}, "Connection: close\r\nRange: " + ranges + "\r\n"));
  EXPECT_EQ(status_of(wire.read_to_end()), 200);
}

TEST(HttpServer, ManySilentConnectionsGiveTheirPlacesToOthers) {
  // More than the server keeps: those that have been silent for longest are closed.
  const Router router = echo();
  const Served served(router);
  std::vector<std::unique_ptr<Wire>> silent;
  for (int i = 0; i < 600; ++i) silent.push_back(std::make_unique<Wire>(served.port()));
  EXPECT_EQ(status_of(ask(served, "GET", "/api/ping")), 200);
  EXPECT_EQ(silent.front()->read_to_end(), "");
}

TEST(HttpServer, RefusedConnectionsGiveTheirPlacesBeforeAllOthers) {
  // More than the server keeps; each announces a body and waits.
  const Router router = echo();
  const Served served(router);
  Wire known(served.port());
  known.send(request_text(served, "GET", "/api/ping", {}, ""));
  EXPECT_EQ(status_of(known.read_answer()), 200);
  std::vector<std::unique_ptr<Wire>> refused;
  const std::string host = "Host: 127.0.0.1:" + std::to_string(served.port()) + "\r\n";
  for (int i = 0; i < 600; ++i) {
    refused.push_back(std::make_unique<Wire>(served.port()));
    refused.back()->send("POST /api/echo HTTP/1.1\r\n" + host + "Content-Length: 900\r\n\r\n");
  }
  for (int i = 0; i < 50; ++i) EXPECT_EQ(status_of(ask(served, "GET", "/api/ping")), 200) << i;
  known.send(request_text(served, "GET", "/api/ping", {}, ""));
  EXPECT_EQ(status_of(known.read_answer()), 200) << "has waited for longer than they, and has its place still";
}

TEST(HttpServer, FiftyClientsAtOnceAreAnsweredWhileOthersSayNothing) {
  const Router router = echo();
  const Served served(router);
  std::vector<std::unique_ptr<Wire>> silent;
  for (int i = 0; i < 50; ++i) {
    silent.push_back(std::make_unique<Wire>(served.port()));
    silent.back()->send("GET /api/ping HTTP/1.1\r\nHo");
  }
  std::atomic<int> good = 0;
  {
    std::vector<std::jthread> clients;
    for (int i = 0; i < 50; ++i)
      clients.emplace_back([&] { good += status_of(ask(served, "GET", "/api/ping")) == 200 ? 1 : 0; });
  }
  EXPECT_EQ(good, 50);
}

TEST(HttpServer, SlowReadersHoldUpNobodyAndGetTheirAnswer) {
  // More than sockets hold: the server waits for each of these readers.
  const std::string piece(std::size_t{1} << 16U, 'x');
  constexpr int pieces = 160;
  Router router = echo();
  router.add("GET", "/api/large", [&](const Request&) {
    Answer answer;
    answer.give_pieces = [&](const TakePiece& take) {
      for (int i = 0; i < pieces && take(piece); ++i) continue;
    };
    return answer;
  });
  const Served served(router);
  std::vector<std::unique_ptr<Wire>> slow;
  for (int i = 0; i < 20; ++i) {
    slow.push_back(std::make_unique<Wire>(served.port()));
    slow.back()->send(request_text(served, "GET", "/api/large"));
  }
  for (int i = 0; i < 50; ++i) EXPECT_EQ(status_of(ask(served, "GET", "/api/ping")), 200);
  for (const auto& wire : slow) EXPECT_GT(wire->read_to_end().size(), pieces * piece.size());
}

TEST(HttpServer, AClientThatHangsUpIsNoticedWhileItsAnswerIsMade) {
  // The handler waits for nothing else.
  std::mutex mutex;
  std::condition_variable changed;
  bool has_begun = false, was_noticed = false;
  Router router;
  router.add("GET", "/api/long", [&](const Request& request) -> Answer {
    std::unique_lock lock(mutex);
    has_begun = true;
    changed.notify_all();
    while (!request.client_has_left()) changed.wait_for(lock, std::chrono::milliseconds(1));
    was_noticed = true;
    changed.notify_all();
    return {};
  });
  const Served served(router);
  Wire wire(served.port());
  wire.send(request_text(served, "GET", "/api/long"));
  std::unique_lock lock(mutex);
  ASSERT_TRUE(changed.wait_for(lock, std::chrono::minutes(1), [&] { return has_begun; }));
  wire.close();
  EXPECT_TRUE(changed.wait_for(lock, std::chrono::minutes(1), [&] { return was_noticed; }));
}

TEST(HttpServer, AnEmptyAddressAndAPortOfTheAdministratorAreSentences) {
  const Router router = echo();
  const Assets assets("no-such-folder");
  const auto sentence = [&](const ServedPlace& place) {
    return test::refusal_of([&] { const HttpServer server(router, assets, place, "token"); });
  };
  EXPECT_NE(sentence({"", 0}).find("--host is empty"), std::string::npos);
  EXPECT_NE(sentence({"no such host", 0}).find("not an address of this machine"), std::string::npos);
  if (::geteuid() == 0) GTEST_SKIP() << "the administrator may take every port";
  EXPECT_NE(sentence({"127.0.0.1", 80}).find("administrator"), std::string::npos);
}

TEST(HttpServer, APortInUseIsOneSentence) {
  const Router router = echo();
  const Served served(router);
  const Assets assets("no-such-folder");
  const std::string sentence = test::refusal_of([&] {
    const HttpServer second(router, assets, {"127.0.0.1", served.port()}, "token");
  });
  EXPECT_NE(sentence.find("cannot be taken"), std::string::npos) << sentence;
  EXPECT_NE(test::refusal_of([&] {
              const HttpServer other(router, assets, {"192.0.2.1", 0}, "token");
            }).find("not an address of this machine"),
            std::string::npos);
}

}  // namespace
}  // namespace rheocyte::http_server_test
