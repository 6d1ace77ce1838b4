#include "measurement/medium.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "case/nearest_name.h"
#include "numeric/number_from_chars.h"

namespace rheocyte {

namespace {

struct Concentration {
  double percent;
  Medium medium;
};
// As they are weighed, and as they are called when rounded.
constexpr std::array<Concentration, 6> concentrations{{{0.49, Medium::methyl_cellulose_049},
                                                       {0.5, Medium::methyl_cellulose_049},
                                                       {0.59, Medium::methyl_cellulose_059},
                                                       {0.6, Medium::methyl_cellulose_059},
                                                       {0.83, Medium::methyl_cellulose_083},
                                                       {0.8, Medium::methyl_cellulose_083}}};
constexpr std::array<std::string_view, 12> words_of_solutions{
    "mc", "pbs", "methyl", "cellulose", "methylcellulose", "in", "w", "v", "wt", "1x", "solution", "buffer"};
constexpr std::array<std::string_view, 3> words_of_cellulose{"mc", "cellulose", "methylcellulose"};

bool is_one_of(std::span<const std::string_view> words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

/// A name in its parts: small letters and digits without what separates them, and the numbers in front of "%".
struct NameParts {
  std::vector<std::string> words;
  std::vector<double> percentages;

  std::string joined() const {
    std::string all;
    for (const auto& word : words) all += word;
    return all;
  }
};

bool is_in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// The number at this place if "%" or "wt%" follows, and then what is behind it.
std::optional<std::pair<double, std::string_view>> percentage_at(std::string_view text) {
  double number = 0;
  const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  if (error != std::errc{}) return std::nullopt;
  auto rest = text.substr(static_cast<std::size_t>(end - text.data()));
  rest.remove_prefix(std::min(rest.find_first_not_of(" _\t"), rest.size()));
  if (rest.starts_with("wt")) rest.remove_prefix(2);
  if (!rest.starts_with('%')) return std::nullopt;
  return std::pair(number, rest.substr(1));
}

NameParts parts_of(std::string_view name) {
  std::string text(name);
  for (char& c : text) c = c == ',' ? '.' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  NameParts parts;
  std::string_view rest = text;
  while (!rest.empty()) {
    if (const auto found = percentage_at(rest)) {
      parts.percentages.push_back(found->first);
      rest = found->second;
      continue;
    }
    const auto end = static_cast<std::size_t>(std::ranges::find_if_not(rest, is_in_word) - rest.begin());
    if (end > 0) parts.words.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::max<std::size_t>(end, 1));
  }
  return parts;
}

bool is_a_solution(const NameParts& parts) {
  const auto is_known = [](const std::string& word) { return is_one_of(words_of_solutions, word); };
  const auto is_cellulose = [](const std::string& word) { return is_one_of(words_of_cellulose, word); };
  return std::ranges::all_of(parts.words, is_known) &&
         (parts.words.empty() || std::ranges::any_of(parts.words, is_cellulose));
}

const Concentration& nearest_concentration(double percent) {
  return *std::ranges::min_element(concentrations, {},
                                   [=](const Concentration& c) { return std::abs(std::log(percent / c.percent)); });
}

}  // namespace

std::optional<Medium> medium_of_name(std::string_view name) {
  const NameParts parts = parts_of(name);
  if (parts.percentages.empty()) {
    const std::string word = parts.joined();
    if (word == "cellcarrier") return Medium::methyl_cellulose_049;
    if (word == "cellcarrierb") return Medium::methyl_cellulose_059;
    return word == "water" ? std::optional(Medium::water) : std::nullopt;
  }
  const double percent = parts.percentages.front();
  if (parts.percentages.size() > 1 || !(percent > 0) || !is_a_solution(parts)) return std::nullopt;
  const Concentration& nearest = nearest_concentration(percent);
  constexpr double as_written = 1e-6;
  return std::abs(percent - nearest.percent) < as_written ? std::optional(nearest.medium) : std::nullopt;
}

std::string_view name_of(Medium medium) {
  switch (medium) {
    case Medium::methyl_cellulose_049: return "0.49% MC-PBS";
    case Medium::methyl_cellulose_059: return "0.59% MC-PBS";
    case Medium::methyl_cellulose_083: return "0.83% MC-PBS";
    default: return "water";
  }
}

std::string near_medium(std::string_view name) {
  constexpr std::array<std::string_view, 3> words{"CellCarrier", "CellCarrierB", "water"};
  constexpr double farthest = 1.5;  // as a ratio
  const NameParts parts = parts_of(name);
  if (parts.percentages.empty()) return did_you_mean(name, words);
  if (!is_a_solution(parts)) return "";  // of another polymer
  const double percent = parts.percentages.front();
  const Concentration& nearest = nearest_concentration(percent);
  if (!(std::abs(std::log(percent / nearest.percent)) < std::log(farthest))) return "";
  return fmt::format(", did you mean {}?", name_of(nearest.medium));
}

}  // namespace rheocyte
