#include "view/moduli_columns.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>

#include "case/refuse_path.h"
#include "case/split.h"
#include "infer/several_moduli.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

struct NamedColumn {
  const char *name, *in_table;
  bool only_resolved;
};
constexpr std::array<NamedColumn, 4> offered{{{"young_modulus_with_cortex_kPa", "young_modulus_kPa", true},
                                              {"cortex_modulus_mN_per_m", "cortex_modulus_mN_per_m", true},
                                              {"tension_mN_per_m", "tension_mN_per_m", true},
                                              {"stiffness_kPa", "stiffness_kPa", false}}};

double number_of(const std::string& text) {
  double number = no_value;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

std::vector<std::string> ModuliColumns::names() {
  std::vector<std::string> all;
  for (const NamedColumn& column : offered) all.emplace_back(column.name);
  return all;
}

ModuliColumns::ModuliColumns(const std::filesystem::path& table) {
  std::ifstream stream(table);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> heads = split(line, '\t');
  const auto place_of = [&](const std::string& head) {
    const auto found = std::ranges::find(heads, head);
    if (found == heads.end()) refuse_path(table, "is no table of `rheocyte moduli`.");
    return std::size_t(found - heads.begin());
  };
  const std::size_t status = place_of("status");
  std::array<std::size_t, offered.size()> places{};
  std::ranges::transform(offered, places.begin(), [&](const NamedColumn& column) { return place_of(column.in_table); });
  while (std::getline(stream, line)) {
    if (line.starts_with('#')) continue;
    const std::vector<std::string> cells = split(line, '\t');
    if (cells.size() < heads.size()) refuse_path(table, "a line is too short.");
    const bool is_resolved = cells[status] == name_of(ModuliStatus::resolved);
    for (std::size_t k = 0; k < offered.size(); ++k)
      columns_[offered[k].name].push_back(offered[k].only_resolved && !is_resolved ? no_value
                                                                                   : number_of(cells[places[k]]));
  }
}

void ModuliColumns::read(const std::string& name, std::size_t first, std::span<double> values) const {
  const std::vector<double>& column = columns_.at(name);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = first + i < column.size() ? column[first + i] : no_value;
}

}  // namespace rheocyte
