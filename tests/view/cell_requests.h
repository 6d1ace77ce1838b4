// The interface to cells as a page or a script gets it, and what its answers hold.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "store/base64.h"
#include "view/view_routes.h"

namespace rheocyte::cell_requests {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The interface on a folder of its own.
class CellRequests : public testing::Test {
 protected:
  ~CellRequests() override { fs::remove_all(folder_); }

  Answer post(std::string path, const Json& body, Request::Names query = {}, std::string method = "POST") {
    return routes_.router().answer(
        {.method = std::move(method), .path = std::move(path), .query = std::move(query), .body = body.dump()});
  }
  Json json(std::string path, const Json& body, Request::Names query = {}) {
    return Json::parse(post(std::move(path), body, std::move(query)).body);
  }

  static fs::path new_folder() {
    std::string pattern = (fs::temp_directory_path() / "rheocyte-view-XXXXXX").string();
    return ::mkdtemp(pattern.data());
  }

  fs::path folder_ = new_folder();
  ViewRoutes routes_{{}, folder_};
};

/// The lines of an answer that comes in pieces.
inline std::vector<Json> lines_of(const Answer& answer) {
  if (!answer.give_pieces) throw std::runtime_error(answer.body);
  std::string text;
  answer.give_pieces([&](std::string_view piece) {
    text += piece;
    return true;
  });
  std::istringstream lines(text);
  std::vector<Json> all;
  for (std::string line; std::getline(lines, line);) all.push_back(Json::parse(line));
  return all;
}

inline std::vector<float> floats(const Json& text) {
  std::string bytes;
  EXPECT_TRUE(decode_base64(text.get<std::string>(), bytes));
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

/// The least of one component of vectors one after another.
inline float least(const std::vector<float>& numbers, std::size_t components, std::size_t component) {
  float found = HUGE_VALF;
  for (std::size_t i = component; i < numbers.size(); i += components) found = std::min(found, numbers[i]);
  return found;
}

inline Json cell(double modulus = 4) {
  return {{"channel", {{"width_um", 20}}},
          {"flow", {{"rate_ul_per_s", 0.04}, {"viscosity_mPas", 15}}},
          {"cell", {{"radius_um", 7}, {"bulk", {{"young_modulus_kPa", modulus}}}}},
          {"numerics", {{"accuracy", 1e-3}}}};
}

}  // namespace rheocyte::cell_requests
