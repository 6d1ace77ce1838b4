#include "experiment/population_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "case/refuse_path.h"
#include "case/split.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "experiment/condition_reports.h"

namespace rheocyte {
namespace {

namespace fs = std::filesystem;

constexpr std::array measure_words{std::pair(std::string_view("asymmetry"), StiffnessMeasure::asymmetry),
                                   std::pair(std::string_view("odd-deformation"), StiffnessMeasure::odd_deformation),
                                   std::pair(std::string_view("deformation"), StiffnessMeasure::deformation)};

/// The name that begins with this part; then it is the next one's turn. A name with commas is one where there is such a
/// file.
std::string next_name(const std::vector<std::string>& parts, std::size_t& part) {
  std::string name;
  for (std::size_t end = part; end < parts.size(); ++end) {
    std::error_code error;
    name += (end > part ? "," : "") + parts[end];
    if (!fs::is_regular_file(to_path(name), error)) continue;
    part = end + 1;
    return name;
  }
  return parts[part++];
}

PopulationCondition condition_of(const std::string& text) {
  const auto sign = text.find('=');
  const auto refuse = [&text](const char* how) {
    throw UserError(fmt::format("rheocyte: --condition {}: {}", one_line(text, 60), how));
  };
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size())
    refuse("give a name and its recordings, for example --condition control=A.rtdc,B.rtdc.");
  PopulationCondition condition{text.substr(0, sign), {}};
  const std::vector<std::string> parts = split(std::string_view(text).substr(sign + 1), ',');
  for (std::size_t part = 0; part < parts.size();) {
    const std::string name = next_name(parts, part);
    if (name.empty()) refuse("the name of a recording is empty.");
    condition.recordings.push_back(to_path(name));
  }
  return condition;
}

/// It is a part of the names of files, and a word of tables.
void check_name(const std::string& name) {
  constexpr std::size_t longest = 100;
  const bool is_word =
      std::ranges::none_of(name, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '/' || c == '\\'; });
  if (!is_word || name.size() > longest)
    throw UserError(
        fmt::format("rheocyte: the condition {}: a name has no more than {} characters, and neither slashes "
                    "nor line breaks or tabs.",
                    one_line(name, 60), longest));
}

void check_files(const std::vector<PopulationCondition>& conditions) {
  std::set<fs::path> known;
  for (const auto& condition : conditions)
    for (const auto& file : condition.recordings) {
      std::error_code error;
      const fs::path whole = fs::weakly_canonical(file, error);
      if (!known.insert(error ? file : whole).second)
        refuse_path(file, "is named twice; each recording counts once and belongs to one condition.");
    }
}

void check_pairs(const std::vector<PopulationCondition>& conditions) {
  for (const auto& condition : conditions)
    if (condition.recordings.size() != conditions.front().recordings.size())
      throw UserError(fmt::format(
          "rheocyte: --paired needs equally many recordings of each condition, the first of each from one session and "
          "so on, but {} has {} and {} has {}.",
          conditions.front().name, conditions.front().recordings.size(), condition.name, condition.recordings.size()));
}

}  // namespace

std::vector<PopulationCondition> conditions_of(const PopulationOptions& options) {
  std::vector<PopulationCondition> conditions;
  for (const std::string& text : options.conditions) conditions.push_back(condition_of(text));
  check_conditions(conditions, options.paired);
  return conditions;
}

void check_conditions(const std::vector<PopulationCondition>& conditions, bool paired) {
  if (conditions.empty())
    throw UserError(
        "rheocyte: no condition is given; for example --condition control=A.rtdc,B.rtdc --condition "
        "drug=C.rtdc,D.rtdc, or a SPEC.toml with a section [conditions].");
  for (const auto& [name, recordings] : conditions) {
    check_name(name);
    if (recordings.empty())
      throw UserError(fmt::format("rheocyte: the condition {} has no recordings.", one_line(name, 60)));
    if (std::ranges::count(conditions, name, &PopulationCondition::name) > 1)
      throw UserError(fmt::format("rheocyte: the condition {} is given twice; name all its recordings at once.",
                                  one_line(name, 60)));
  }
  check_files(conditions);
  if (paired) check_pairs(conditions);
}

StiffnessMeasure stiffness_measure_of(const PopulationOptions& options) {
  if (options.model == "effective") return StiffnessMeasure::odd_deformation;
  if (options.by.empty()) return StiffnessMeasure::asymmetry;
  for (const auto& [word, by] : measure_words)
    if (word == options.by) return by;
  throw UserError(fmt::format("rheocyte: --by {}: it must be asymmetry, odd-deformation or deformation.",
                              one_line(options.by, 40)));
}

std::string_view name_of(StiffnessMeasure by) {
  return std::ranges::find(measure_words, by, &decltype(measure_words)::value_type::second)->first;
}

bool PopulationReport::has_failures() const {
  return std::ranges::any_of(recordings, [](const auto& r) { return !r.failure.empty(); });
}

std::vector<PopulationQuantity> PopulationReport::quantities() const { return quantities_told(recordings); }

}  // namespace rheocyte
