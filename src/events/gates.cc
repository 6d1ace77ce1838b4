#include "events/gates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "events/polygon_file.h"
#include "numeric/fingerprint.h"
#include "numeric/number_from_chars.h"

namespace rheocyte {

namespace {

std::pair<std::string, double> parsed(const std::string& text, const char* option) {
  const auto sign = text.find('=');
  double value = NAN;
  if (sign != std::string::npos && sign > 0) {
    const char* const end = text.data() + text.size();
    const auto [stop, error] = number_from_chars(text.data() + sign + 1, end, value);
    if (error != std::errc{} || stop != end) value = NAN;
  }
  if (!std::isfinite(value))
    throw UserError(fmt::format("rheocyte: {} {}: give a feature and a number, for example {} area_ratio=1.05.", option,
                                one_line(text, 60), option));
  return {text.substr(0, sign), value};
}

/// Of features by dclab's names.
bool is_of_shape(std::string_view feature) {
  return feature == "deform" || feature == "circ" || feature == "emodulus" || feature.starts_with("inert_ratio");
}

}  // namespace

Gates::Gates(const GateOptions& options) {
  for (const auto& text : options.min) {
    const auto [feature, value] = parsed(text, "--min");
    limit_of(feature).min = value;
  }
  for (const auto& text : options.max) {
    const auto [feature, value] = parsed(text, "--max");
    limit_of(feature).max = value;
  }
  for (const auto& limit : limits_)
    if (limit.min > limit.max)
      throw UserError(
          fmt::format("rheocyte: --min and --max of {} contradict each other: no number is at least {} and at "
                      "most {}.",
                      one_line(limit.feature, 60), limit.min, limit.max));
  for (const auto& text : options.polygons)
    for (auto& polygon : polygon_gates(text)) polygons_.push_back(std::move(polygon));
  events_ = options.events;
  if (events_) std::ranges::sort(*events_);
}

std::string_view Gates::options_of(const Limit& limit) {
  if (!std::isfinite(limit.max)) return "--min gives";
  return std::isfinite(limit.min) ? "--min and --max give" : "--max gives";
}

Gates::Limit& Gates::limit_of(const std::string& feature) {
  const auto found = std::ranges::find(limits_, feature, &Limit::feature);
  if (found != limits_.end()) return *found;
  return limits_.emplace_back(Limit{feature});
}

bool Gates::limit_shapes() const {
  return std::ranges::any_of(limits_, [](const Limit& limit) { return is_of_shape(limit.feature); }) ||
         std::ranges::any_of(polygons_, [](const PolygonGate& polygon) { return polygon.is_over(is_of_shape); });
}

Gates Gates::without_shapes() const {
  Gates others = *this;
  std::erase_if(others.limits_, [](const Limit& limit) { return is_of_shape(limit.feature); });
  others.polygons_.clear();
  for (const auto& polygon : polygons_) {
    if (!polygon.is_over(is_of_shape)) {
      others.polygons_.push_back(polygon);
    } else if (const auto range = polygon.range_of_other(is_of_shape)) {
      Limit& limit = others.limit_of(range->feature);
      limit.min = std::max(limit.min, range->min), limit.max = std::min(limit.max, range->max);
    }
  }
  return others;
}

std::string Gates::description() const { return description_without({}); }

Gates::Limits Gates::limits_of(std::string_view feature) const {
  const auto found = std::ranges::find(limits_, feature, &Limit::feature);
  const Limit limit = found == limits_.end() ? Limit{} : *found;
  return {limit.min, limit.max};
}

std::vector<std::vector<PolygonGate::Corner>> Gates::outlines_over(std::string_view x, std::string_view y) const {
  std::vector<std::vector<PolygonGate::Corner>> outlines;
  for (const auto& polygon : polygons_)
    if (auto outline = polygon.outline_over(x, y); !outline.empty()) outlines.push_back(std::move(outline));
  return outlines;
}

std::string Gates::description_without(std::initializer_list<std::string_view> features) const {
  std::string text;
  for (const auto& [feature, min, max] : limits_) {
    if (std::ranges::find(features, feature) != features.end()) continue;
    if (!text.empty()) text += ", ";
    if (std::isfinite(min)) text += fmt::format("{} <= ", min);
    text += one_line(feature, 60);
    if (std::isfinite(max)) text += fmt::format(" <= {}", max);
  }
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
  for (const auto& polygon : polygons_) add(polygon.description());
  if (events_) add(fmt::format("{} chosen events", events_->size()));
  return text;
}

std::vector<std::string> Gates::lines_in_full() const {
  std::vector<std::string> lines;
  for (const auto& [feature, min, max] : limits_) lines.push_back(fmt::format("{} <= {} <= {}", min, feature, max));
  for (const auto& polygon : polygons_) lines.push_back(polygon.description_in_full());
  if (events_)
    lines.push_back(fmt::format("chosen events {}", fingerprint(fmt::format("{}", fmt::join(*events_, ",")))));
  return lines;
}

void Gates::check(const EventFeatures& features) const {
  for (const auto& limit : limits_)
    if (!features.has(limit.feature))
      refuse_path(features.recording().file(),
                  fmt::format("has no feature {}, for which {} a limit.{}", one_line(limit.feature, 60),
                              options_of(limit), features.near(limit.feature)));
  for (const auto& polygon : polygons_) polygon.check(features);
}

void Gates::apply(EventFeatures& features, std::size_t first, std::vector<char>& inside) const {
  std::ranges::fill(inside, events_ ? char{0} : char{1});
  if (events_)
    for (auto event = std::ranges::lower_bound(*events_, first);
         event != events_->end() && *event < first + inside.size(); ++event)
      inside[*event - first] = 1;
  std::vector<double> values(inside.size());
  for (const auto& [feature, min, max] : limits_) {
    features.read(feature, first, values);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(values[i] >= min && values[i] <= max)) inside[i] = 0;
  }
  for (const auto& polygon : polygons_) polygon.apply(features, first, inside);
}

}  // namespace rheocyte
