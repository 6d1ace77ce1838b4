// "did you mean ...": the known name next to a misspelt one.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rheocyte {

/// Least number of inserted, deleted, replaced or swapped neighbouring characters that turns one word into the
/// other; capitals do not count.
int edit_distance(std::string_view, std::string_view);

/// The nearest of the known names, or nothing if none is near. Dotted names also match by their last part, so that
/// a key in the wrong section and a key without its unit ("radius" for "radius_um") are found.
std::optional<std::string_view> nearest_name(std::string_view wanted, std::span<const std::string_view> known);

/// ", did you mean ...?" or, if nothing is near, an empty text.
std::string did_you_mean(std::string_view wanted, std::span<const std::string_view> known);

}  // namespace rheocyte
