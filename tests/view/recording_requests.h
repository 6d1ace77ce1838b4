// The interface to recordings as a page or a script gets it, and what stands in files beside it.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "case/json_guard.h"
#include "measurement/recording_writer.h"
#include "report/extract_recording.h"
#include "view/view_routes.h"
#include "virtual_cells.h"

namespace rheocyte::recording_requests {

namespace fs = std::filesystem;
using test::RecordingWriter;
using Json = nlohmann::ordered_json;

/// A server's insides without a server.
class RecordingRequests : public testing::Test {
 protected:
  void open(const std::string& name, const std::function<void(RecordingWriter&)>& fill) {
    {
      RecordingWriter writer(folder_ / name);
      test::write_usual_metadata(writer);
      fill(writer);
    }
    open(folder_ / name);
  }
  void open_virtual_cells(int cells) {
    test::write_virtual_cells(folder_ / "cells.rtdc", cells);
    open(folder_ / "cells.rtdc");
  }
  /// Other cells in the place of those of a file, which is written into.
  void write_over(const std::string& name, int cells, int seed) {
    test::write_virtual_cells(folder_ / "others.rtdc", cells, seed);
    fs::rename(folder_ / "others.rtdc", folder_ / name);  // one that is open in this process cannot be written again
  }
  void wait_until_described() const {
    for (int round = 0; round < 3000 && json("GET", "/api/items")[0]["state"] == "loading"; ++round)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  void open(const fs::path& file) {
    const std::array<fs::path, 1> paths{file};
    routes_.emplace(paths, folder_ / "out");
  }

  Answer ask(const std::string& method, const std::string& path, Request::Names query = {},
             const std::string& body = {}) const {
    Request request;
    request.method = method;
    request.path = path;
    request.query = std::move(query);
    request.body = body;
    return routes_->router().answer(request);
  }
  static std::string bytes_of(const Answer& answer) {
    std::string bytes;
    answer.give_pieces([&](std::string_view piece) {
      bytes += piece;
      return true;
    });
    return bytes;
  }

  Json json(const std::string& method, const std::string& path, const std::string& body = {}) const {
    return parse_sound_json(ask(method, path, {}, body).body);
  }
  /// Once it no longer runs.
  Json moduli(const Json& settings) const {
    const Answer started = ask("POST", "/api/items/0/moduli", {}, json_text(settings));
    EXPECT_EQ(started.status, 202) << started.body;
    Json state;
    for (int round = 0; round < 3000; ++round) {
      state = json("GET", "/api/items/0/moduli");
      if (state["state"] != "running") break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return state;
  }
  Json exported(const std::string& what, const std::string& name, const Json& gate = nullptr) const {
    return json("POST", "/api/export", json_text({{"what", what}, {"item", 0}, {"name", name}, {"gate", gate}}));
  }

  test::ScratchFolder folder_;
  std::optional<ViewRoutes> routes_;
};

template <class Number>
std::vector<Number> numbers_in(const std::string& bytes) {
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

inline std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::vector<double> column(const fs::path& file, const std::string& feature) {
  const Recording recording(file);
  std::vector<double> values(recording.events());
  recording.read_scalar(feature, 0, values);
  return values;
}

inline void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0) << "to the last bit, NaN included";
}

/// What `rheocyte extract` writes.
inline ExtractSummary extract(const fs::path& file, const ExtractOutput& output, const ExtractOptions& options = {}) {
  ExtractFiles files(output, true);
  const auto summary = extract_recording(file, files, options, ModulusTables(options.table), [](double) {});
  files.publish();
  return summary;
}

}  // namespace rheocyte::recording_requests
