#include "measurement/reference_files.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace rheocyte::test {

std::filesystem::path reference_folder() { return RHEOCYTE_REFERENCE; }

double CsvTable::number(const std::string& column, std::size_t row) const {
  return std::strtod(text(column, row).c_str(), nullptr);
}

CsvTable read_csv(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream text(line.ends_with('\r') ? line.substr(0, line.size() - 1) : line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    return cells;
  };
  CsvTable table;
  std::string line;
  std::getline(stream, line);
  const auto names = cells_of(line);
  while (std::getline(stream, line)) {
    const auto cells = cells_of(line);
    for (std::size_t i = 0; i < names.size(); ++i) table.columns[names[i]].push_back(cells.at(i));
  }
  return table;
}

}  // namespace rheocyte::test
