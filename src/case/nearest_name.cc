#include "case/nearest_name.h"

#include <algorithm>
#include <vector>

namespace rheocyte {

namespace {

// Longer words are no misspelling of a key; the bound keeps the quadratic distance cheap for hostile input.
constexpr std::size_t max_length = 64;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string_view last_part(std::string_view name) {
  const auto dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

bool lacks_only_its_unit(std::string_view wanted, std::string_view known) {
  return wanted.size() >= 3 && known.size() > wanted.size() && known[wanted.size()] == '_' &&
         edit_distance(wanted, known.substr(0, wanted.size())) == 0;
}

struct Likeness {
  int full, last;  // compared in this order after their minimum
  int best() const { return std::min(full, last); }
  bool operator<(const Likeness& other) const {
    return best() != other.best() ? best() < other.best() : full < other.full;
  }
};

Likeness likeness(std::string_view wanted, std::string_view known) {
  const auto wanted_last = last_part(wanted), known_last = last_part(known);
  const int last = lacks_only_its_unit(wanted_last, known_last) ? 1 : edit_distance(wanted_last, known_last);
  return {edit_distance(wanted, known), last};
}

bool near_enough(const Likeness& found, std::string_view wanted) {
  const auto allowed = [](std::string_view word) {
    return std::max(1, std::min(5, static_cast<int>(word.size()) / 3));
  };
  return found.full <= allowed(wanted) || found.last <= allowed(last_part(wanted));
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = above[j - 1] + (lower(a[i - 1]) != lower(b[j - 1]));
      row[j] = std::min({replace, above[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

std::optional<std::string_view> nearest_name(std::string_view wanted, std::span<const std::string_view> known) {
  if (known.empty() || wanted.empty() || wanted.size() > max_length) return std::nullopt;
  const auto nearest = std::min_element(known.begin(), known.end(),
                                        [&](auto a, auto b) { return likeness(wanted, a) < likeness(wanted, b); });
  if (!near_enough(likeness(wanted, *nearest), wanted)) return std::nullopt;
  return *nearest;
}

std::string did_you_mean(std::string_view wanted, std::span<const std::string_view> known) {
  const auto nearest = nearest_name(wanted, known);
  return nearest ? ", did you mean " + std::string(*nearest) + "?" : "";
}

}  // namespace rheocyte
