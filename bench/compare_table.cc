// How a finished table compares with a published one: compare_table DIR PUBLISHED.txt [POINTS.csv]
//
// For each row of the published table (dclab's format) the stiffness at its area and deformation is taken from our
// branches. Printed: median, 95th percentile and maximum of the relative difference, and why rows have no answer.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "numeric/quantile.h"
#include "program.h"
#include "table/table_folder.h"
#include "table/table_interpolation.h"

namespace {

using namespace rheocyte;

void print_distribution(const char* name, const std::vector<double>& differences) {
  if (differences.empty()) return;
  fmt::print("{:<12} {:>6} rows, median {:.3f} %, 95 % below {:.3f} %, greatest {:.3f} %\n", name, differences.size(),
             100 * quantile(differences, 0.5), 100 * quantile(differences, 0.95), 100 * std::ranges::max(differences));
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 3) return fmt::print("compare_table DIR PUBLISHED.txt [POINTS.csv]\n"), 2;
  const TableSpec spec = read_table_spec(std::string(argv[1]) + "/spec.toml");
  const auto branches = TableFolder(argv[1], spec).all_branches();
  const TableInterpolation table(spec, branches);
  std::ifstream published(argv[2]);
  std::ofstream points(argc > 3 ? argv[3] : "/dev/null");
  points << "area_um2,deformation,published_kPa,rheocyte_kPa,regularised,reason\n";
  std::vector<double> bare, regularised;
  std::map<std::string, int> without;
  for (std::string line; std::getline(published, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream numbers(line);
    double area = 0, deformation = 0, stiffness = 0;
    numbers >> area >> deformation >> stiffness;
    const StiffnessAnswer answer = table.by_area(area, deformation);
    const std::string reason(name_of(answer.reason));
    points << fmt::format("{},{},{},{},{},{}\n", area, deformation, stiffness, answer.stiffness,
                          int(answer.regularised), reason);
    if (answer.reason != OutOfTable::none) {
      ++without[reason];
    } else {
      (answer.regularised ? regularised : bare).push_back(std::abs(answer.stiffness / stiffness - 1));
    }
  }
  print_distribution("bare", bare);
  print_distribution("regularised", regularised);
  for (const auto& [reason, count] : without) fmt::print("{:<12} {:>6} rows\n", reason, count);
  return 0;
}
