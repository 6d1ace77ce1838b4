#include "events/polygon_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "numeric/no_value.h"
#include "numeric/number_from_chars.h"

namespace rheocyte {

namespace {

constexpr std::string_view logarithmic = "log:";
constexpr std::size_t fewest_corners = 3;

double corner_number(std::string_view text) {
  double value = no_value;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = number_from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end ? value : no_value;
}

[[noreturn]] void refuse_polygon(const std::string& text, std::string_view why) {
  throw UserError(
      fmt::format("rheocyte: --polygon {}: {}; for example --polygon area_um,deform=40,0.01:90,0.01:90,0.1, or a file "
                  "of filters, --polygon FILE.poly.",
                  one_line(text, 60), why));
}

}  // namespace

double PolygonGate::Axis::place(double value) const { return is_log ? std::log10(value) : value; }

double PolygonGate::Axis::value(double place) const { return is_log ? std::pow(10, place) : place; }

PolygonGate::Axis PolygonGate::axis_of(const std::string& name) {
  const bool is_log = name.starts_with(logarithmic);
  return {is_log ? name.substr(logarithmic.size()) : name, is_log};
}

PolygonGate::PolygonGate(const std::string& text) {
  if (text.ends_with(".so2"))
    refuse_polygon(text, "is a session of DCscope; export its polygon filters there as .poly");
  const auto sign = text.find('='), comma = text.find(',');
  if (sign == std::string::npos || comma >= sign) refuse_polygon(text, "give two features and the corners");
  x_ = axis_of(text.substr(0, comma));
  y_ = axis_of(text.substr(comma + 1, sign - comma - 1));
  if (x_.feature.empty() || y_.feature.empty()) refuse_polygon(text, "give two features and the corners");
  std::string_view rest = std::string_view(text).substr(sign + 1);
  while (!rest.empty()) {
    const std::string_view corner = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(rest.size(), corner.size() + 1));
    const auto middle = std::min(corner.find(','), corner.size());
    const double x = x_.place(corner_number(corner.substr(0, middle))),
                 y = y_.place(corner_number(corner.substr(std::min(middle + 1, corner.size()))));
    if (!std::isfinite(x) || !std::isfinite(y))
      refuse_polygon(text, "a corner is two numbers, which are positive on a logarithmic axis");
    corners_.push_back({x, y});
  }
  if (corners_.size() < fewest_corners) refuse_polygon(text, "give at least three corners");
}

PolygonGate::PolygonGate(Shape shape)
    : x_{std::move(shape.x), false},
      y_{std::move(shape.y), false},
      corners_(std::move(shape.corners)),
      is_inverted_(shape.is_inverted) {}

std::string PolygonGate::description() const {
  return fmt::format("{},{} {} a polygon of {} corners", one_line(x_.feature, 60), one_line(y_.feature, 60),
                     is_inverted_ ? "outside" : "in", corners_.size());
}

std::string PolygonGate::description_in_full() const {
  std::string text = fmt::format("{}{},{}{} {}", x_.is_log ? "log:" : "", x_.feature, y_.is_log ? "log:" : "",
                                 y_.feature, is_inverted_ ? "outside" : "in");
  for (const auto& [x, y] : corners_) text += fmt::format(" {},{}", x, y);
  return text;
}

void PolygonGate::check(const EventFeatures& features) const {
  for (const Axis& axis : {x_, y_})
    if (!features.has(axis.feature))
      refuse_path(features.recording().file(), fmt::format("has no feature {}, which --polygon names.{}",
                                                           one_line(axis.feature, 60), features.near(axis.feature)));
}

bool PolygonGate::holds(double x, double y) const {
  bool is_inside = false;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    Corner a = corners_[k], b = corners_[(k + 1) % corners_.size()];
    if (a.y > b.y) std::swap(a, b);
    if (y >= a.y && y < b.y && x < a.x + (b.x - a.x) / (b.y - a.y) * (y - a.y)) is_inside = !is_inside;
  }
  return is_inside;
}

bool PolygonGate::is_over(bool (*is_such)(std::string_view)) const {
  return is_such(x_.feature) || is_such(y_.feature);
}

std::optional<PolygonGate::Range> PolygonGate::range_of_other(bool (*is_such)(std::string_view)) const {
  if (is_inverted_ || is_such(x_.feature) == is_such(y_.feature)) return {};
  const bool is_x = !is_such(x_.feature);
  const auto along = is_x ? &Corner::x : &Corner::y;
  const auto [min, max] = std::ranges::minmax_element(corners_, {}, along);
  const Axis& axis = is_x ? x_ : y_;
  return Range{axis.feature, axis.value((*min).*along), axis.value((*max).*along)};
}

std::vector<PolygonGate::Corner> PolygonGate::outline_over(std::string_view x, std::string_view y) const {
  const bool is_swapped = x_.feature == y && y_.feature == x;
  if (!is_swapped && (x_.feature != x || y_.feature != y)) return {};
  const int pieces = x_.is_log || y_.is_log ? 32 : 1;
  std::vector<Corner> outline;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Corner &a = corners_[k], &b = corners_[(k + 1) % corners_.size()];
    for (int piece = 0; piece < pieces; ++piece) {
      const double part = double(piece) / pieces;
      outline.push_back({x_.value(a.x + part * (b.x - a.x)), y_.value(a.y + part * (b.y - a.y))});
      if (is_swapped) std::swap(outline.back().x, outline.back().y);
    }
  }
  return outline;
}

void PolygonGate::apply(EventFeatures& features, std::size_t first, std::vector<char>& inside) const {
  std::vector<double> x(inside.size()), y(inside.size());
  features.read(x_.feature, first, x);
  features.read(y_.feature, first, y);
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (inside[i] && holds(x_.place(x[i]), y_.place(y[i])) == is_inverted_) inside[i] = 0;
}

}  // namespace rheocyte
