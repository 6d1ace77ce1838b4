#include "events/polygon_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>

#include "case/refuse_path.h"
#include "case/stripped.h"
#include "case/to_path.h"
#include "numeric/no_value.h"
#include "numeric/number_from_chars.h"
#include "store/read_file.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes_of_polygons = 16 << 20;

/// Reads the lines of one polygon after the other.
class PolygonReader {
 public:
  explicit PolygonReader(const fs::path& file) : file_(file) {}

  void read(std::string_view line) {
    ++number_;
    line = stripped(line);
    if (line.empty()) return;
    if (line.starts_with('[')) {
      finish();
      is_open_ = true;
      return;
    }
    const auto sign = line.find('=');
    if (!is_open_ || sign == std::string_view::npos) refuse();
    const std::string key = in_small_letters(stripped(line.substr(0, sign)));
    const std::string_view value = stripped(line.substr(sign + 1));
    if (key == "x axis") {
      shape_.x = in_small_letters(value);
    } else if (key == "y axis") {
      shape_.y = in_small_letters(value);
    } else if (key == "inverted") {
      shape_.is_inverted = value == "True";
    } else if (key.starts_with("point")) {
      read_point(key.substr(5), stripped(value, "[] \t"));
    } else if (key != "name") {
      refuse();
    }
  }

  std::vector<PolygonGate> end() {
    finish();
    if (gates_.empty()) refuse_path(file_, "contains no polygon filters; DCscope and dclab save them as .poly files.");
    return std::move(gates_);
  }

 private:
  [[noreturn]] void refuse() const {
    refuse_path(file_,
                fmt::format("line {} is not a line of a polygon filter of DCscope or dclab; save the filter once more.",
                            number_));
  }

  void read_point(std::string_view number, std::string_view value) {
    std::size_t place = 0;
    PolygonGate::Corner corner{no_value, no_value};
    const char* const end = value.data() + value.size();
    const auto index = std::from_chars(number.data(), number.data() + number.size(), place);
    const auto x = number_from_chars(value.data(), end, corner.x);
    const std::string_view rest = stripped({x.ptr, static_cast<std::size_t>(end - x.ptr)});
    const auto y = number_from_chars(rest.data(), rest.data() + rest.size(), corner.y);
    if (index.ec != std::errc{} || y.ptr != rest.data() + rest.size() || !std::isfinite(corner.x + corner.y)) refuse();
    points_[place] = corner;
  }

  void finish() {
    if (!is_open_) return;
    for (const auto& [place, corner] : points_) shape_.corners.push_back(corner);
    if (shape_.x.empty() || shape_.y.empty() || shape_.corners.size() < 3)
      refuse_path(file_, "contains a polygon without two axes or three corners; save the filter once more.");
    gates_.emplace_back(std::move(shape_));
    shape_ = {};
    points_.clear();
  }

  fs::path file_;
  std::size_t number_ = 0;  // of the line
  bool is_open_ = false;
  PolygonGate::Shape shape_;
  std::map<std::size_t, PolygonGate::Corner> points_;
  std::vector<PolygonGate> gates_;
};

std::vector<PolygonGate> polygons_of_file(const fs::path& file) {
  std::istringstream text(content_of_file(file, most_bytes_of_polygons));
  PolygonReader reader(file);
  for (std::string line; std::getline(text, line);) reader.read(line);
  return reader.end();
}

}  // namespace

std::vector<PolygonGate> polygon_gates(const std::string& text) {
  if (is_polygon_file(text)) return polygons_of_file(to_path(text));
  std::vector<PolygonGate> gates;
  gates.emplace_back(text);
  return gates;
}

}  // namespace rheocyte
