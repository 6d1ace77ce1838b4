// Items and events by requests: what recordings hold comes back number for number.
#include "view/recording_routes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "case/json_guard.h"
#include "measurement/recording_writer.h"
#include "view/view_items.h"

namespace rheocyte {
namespace {

namespace fs = std::filesystem;
using test::RecordingWriter;
using Json = nlohmann::ordered_json;

/// A server's insides without a server.
class RecordingRoutes : public testing::Test {
 protected:
  void open(const std::string& name, const std::function<void(RecordingWriter&)>& fill) {
    {
      RecordingWriter writer(folder_ / name);
      test::write_usual_metadata(writer);
      fill(writer);
    }
    const std::array<fs::path, 1> paths{folder_ / name};
    items_.emplace(paths);
    add_recording_routes(router_, exports_, session_, *items_);
  }

  Answer ask(const std::string& method, const std::string& path, Request::Names query = {},
             const std::string& body = {}) const {
    Request request;
    request.method = method;
    request.path = path;
    request.query = std::move(query);
    request.body = body;
    return router_.answer(request);
  }
  static std::string bytes_of(const Answer& answer) {
    std::string bytes;
    answer.give_pieces([&](std::string_view piece) {
      bytes += piece;
      return true;
    });
    return bytes;
  }

  test::ScratchFolder folder_;
  ExportFolder out_{folder_ / "out"};
  Exports exports_{out_};
  ViewSession session_;
  std::optional<ViewItems> items_;
  Router router_;
};

template <class Number>
std::vector<Number> numbers_in(const std::string& bytes) {
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

TEST_F(RecordingRoutes, GiveColumnsOneAfterAnotherAsTheyAreStored) {
  open("a.rtdc", [](RecordingWriter& writer) {
    writer.scalar("area_um", {80.1, 90.2, 100.3});
    writer.scalar("circ", {0.97, NAN, 0.95});
  });
  const Answer answer = ask("GET", "/api/items/0/events", {{"features", "area_um,deform"}, {"type", "float64"}});
  ASSERT_EQ(answer.status, 200) << answer.body;
  ASSERT_EQ(answer.headers.size(), 1u);
  EXPECT_EQ(parse_sound_json(answer.headers[0].second),
            (Json{{"features", {"area_um", "deform"}}, {"events", 3}, {"type", "float64"}}));
  const auto numbers = numbers_in<double>(bytes_of(answer));
  ASSERT_EQ(numbers.size(), 6u);
  EXPECT_EQ(numbers[1], 90.2);
  EXPECT_EQ(numbers[3], 1 - 0.97);
  EXPECT_TRUE(std::isnan(numbers[4]));
}

TEST_F(RecordingRoutes, GiveManyEventsInBlocksAndSinglePrecisionUnlessAsked) {
  std::vector<double> areas(200'001);
  for (std::size_t i = 0; i < areas.size(); ++i) areas[i] = 50 + 1e-3 * static_cast<double>(i);
  open("a.rtdc", [&](RecordingWriter& writer) {
    writer.scalar("area_um", areas);
    writer.scalar("deform", areas);
  });
  const auto numbers = numbers_in<float>(bytes_of(ask("GET", "/api/items/0/events", {{"features", "area_um"}})));
  ASSERT_EQ(numbers.size(), areas.size());
  for (const std::size_t i : {std::size_t{0}, std::size_t{65'536}, std::size_t{200'000}})
    EXPECT_EQ(numbers[i], static_cast<float>(areas[i]));
}

TEST_F(RecordingRoutes, RefuseWhatIsNotThereWithASentence) {
  open("a.rtdc", [](RecordingWriter& writer) { writer.scalar("area_um", {80, 90}); });
  const auto refusal = [&](const std::string& path, Request::Names query, int status, const std::string& words) {
    const Answer answer = ask("GET", path, std::move(query));
    EXPECT_EQ(answer.status, status) << answer.body;
    EXPECT_NE(answer.body.find(words), std::string::npos) << answer.body;
  };
  refusal("/api/items/1", {}, 404, "no item");
  refusal("/api/items/-1/events", {{"features", "area_um"}}, 404, "whole number");
  refusal("/api/items/0/events", {}, 400, "features");
  refusal("/api/items/0/events", {{"features", "area_um,nonsense"}}, 400, "has no feature nonsense");
  refusal("/api/items/0/events", {{"features", "area_um"}, {"type", "int"}}, 400, "float64");
  fs::remove(folder_ / "a.rtdc");
  refusal("/api/items/0/events", {{"features", "area_um"}}, 400, "no such file");
}

}  // namespace
}  // namespace rheocyte
