#include "fem/requested_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rheocyte {
namespace {

/// Elements are at most so long (in the cell's radius), turn by at most so much, and take at most so much of the
/// undeformed cell (both in radians).
constexpr double longest = 0.6, most_turned = 0.5, widest = 0.6;
/// By how much their length may grow along themselves.
constexpr double growth = 0.4;

/// How long an element may be at a point, as a part of the line.
double wanted_size(const LinePoint& point) {
  const double length = point.stretch * point.angle, turn = length * point.curvature;
  return 1 / (length / longest + std::abs(turn) / most_turned + point.angle / widest);
}

/// The same along lines; neighbours differ by little, from either side.
std::vector<double> wanted_sizes(const std::vector<std::vector<LinePoint>>& lines) {
  const std::vector<LinePoint>& first = lines.front();
  std::vector<double> size(first.size(), std::numeric_limits<double>::infinity());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < size.size(); ++i) size[i] = std::min(size[i], wanted_size(line[i]));
  }
  const auto limit = [&](std::size_t i, std::size_t j) {
    size[i] = std::min(size[i], size[j] + growth * std::abs(first[i].place - first[j].place));
  };
  for (std::size_t i = 1; i < size.size(); ++i) limit(i, i - 1);
  for (std::size_t i = size.size() - 1; i-- > 0;) limit(i, i + 1);
  return size;
}

double at(const std::vector<double>& x, const std::vector<double>& y, double value) {
  const auto above = std::size_t(std::ranges::lower_bound(x, value) - x.begin());
  const std::size_t i = std::clamp<std::size_t>(above, 1, x.size() - 1);
  return std::lerp(y[i - 1], y[i], (value - x[i - 1]) / (x[i] - x[i - 1]));
}

}  // namespace

RequestedElements::RequestedElements(const std::vector<std::vector<LinePoint>>& lines) {
  const std::vector<double> size = wanted_sizes(lines);
  for (const LinePoint& point : lines.front()) place_.push_back(point.place);
  for (std::size_t i = 1; i < size.size(); ++i)
    number_.push_back(number_.back() + (place_[i] - place_[i - 1]) * (1 / size[i] + 1 / size[i - 1]) / 2);
}

double RequestedElements::up_to(double place) const { return at(place_, number_, place); }
double RequestedElements::place_of(double number) const { return at(number_, place_, number); }

std::vector<double> RequestedElements::moved(std::vector<double> breaks, double evenly) const {
  const std::size_t n = breaks.size() - 1;
  for (std::size_t k = 1; k < n; ++k)
    breaks[k] = std::lerp(breaks[k], place_of(number_.back() * double(k) / double(n)), evenly);
  return breaks;
}

double RequestedElements::evenness(const std::vector<double>& breaks) const {
  double most = 0;
  for (std::size_t k = 1; k < breaks.size(); ++k) most = std::max(most, up_to(breaks[k]) - up_to(breaks[k - 1]));
  return number_.back() / double(breaks.size() - 1) / most;
}

}  // namespace rheocyte
