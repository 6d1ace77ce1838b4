// How well the structured grid of a finished table repeats the interpolation between its branches: check_grid DIR
// [GRID]
//
// At random areas and deformations, uniform in their logarithms, both answer. With a file of a grid it is said whether
// that is the table's.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <vector>

#include "numeric/quantile.h"
#include "program.h"
#include "table/grid_from_branches.h"
#include "table/table_folder.h"
#include "table/table_interpolation.h"

namespace {

using namespace rheocyte;

void print_differences(const char* what, const std::vector<double>& all) {
  if (all.empty()) return;
  const auto at = [&](double fraction) { return quantile(all, fraction); };
  fmt::print("{}: {} points, median {:.1e}, 95 % {:.1e}, 99.9 % {:.1e}, greatest {:.1e}\n", what, all.size(), at(0.5),
             at(0.95), at(0.999), at(1));
}

/// What the grid and the branches answer at places drawn at random.
class Comparison {
 public:
  void add(double area, double deformation, const StiffnessAnswer& exact, const GridAnswer& ours) {
    if (exact.reason == OutOfTable::none && ours.reason == OutOfTable::none && exact.regularised == ours.regularised) {
      const double difference = std::abs(std::exp(ours.log_stiffness) / exact.stiffness - 1);
      ours.regularised ? add_regularised(difference, ours.error) : add_bare(area, deformation, difference, exact, ours);
    } else if (const auto names = std::pair{name(exact), name(ours)}; names.first != names.second) {
      ++disagreements_[names];
    }
  }

  void print(int places) const {
    print_differences("bare surface", bare_);
    print_differences("of these, deformations of 0.003 to 0.1", usual_);
    print_differences("regularised", held_);
    fmt::print("regularised, beyond three stated errors: {} of {}, at most {:.1f} of them\n", beyond_error_,
               held_.size(), worst_regularised_);
    for (const auto& [names, count] : disagreements_)
      fmt::print("{:.3f} %: {} between the branches, {} in the grid\n", 100.0 * count / places, names.first,
                 names.second);
  }

 private:
  template <class Answer>
  static std::string name(const Answer& answer) {
    if (answer.reason == OutOfTable::none) return answer.regularised ? "regularised" : "bare";
    return std::string(name_of(answer.reason));
  }
  void add_regularised(double difference, double error) {
    held_.push_back(difference);
    if (difference <= 3 * error) return;
    ++beyond_error_;
    worst_regularised_ = std::max(worst_regularised_, difference / error);
  }
  void add_bare(double area, double deformation, double difference, const StiffnessAnswer& exact,
                const GridAnswer& ours) {
    bare_.push_back(difference);
    if (deformation > 0.003 && deformation < 0.1) usual_.push_back(difference);
    if (difference <= worst_) return;
    worst_ = difference;
    fmt::print("  {:.1e} at {:.4g} um2, deformation {:.4g}, errors stated {:.1e} and {:.1e}\n", worst_, area,
               deformation, exact.error, ours.error);
  }

  std::vector<double> bare_, held_, usual_;
  std::map<std::pair<std::string, std::string>, int> disagreements_;
  double worst_ = 0, worst_regularised_ = 0;
  int beyond_error_ = 0;
};

void compare_at_random(const TableSpec& spec, const std::vector<SampledBranch>& branches, const GridContent& content) {
  constexpr int places = 200000;
  const StiffnessGrid grid(content);
  const TableInterpolation table(spec, branches);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log_area(std::log(spec.min_area_um2), std::log(spec.max_area_um2)),
      log_deformation(std::log(spec.min_deformation), std::log(spec.max_deformation));
  Comparison comparison;
  for (int i = 0; i < places; ++i) {
    const double area = std::exp(log_area(random)), deformation = std::exp(log_deformation(random));
    comparison.add(area, deformation, table.by_area(area, deformation), grid.answer(area, deformation));
  }
  comparison.print(places);
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("check_grid DIR [GRID]\n"), 2;
  const TableSpec spec = read_table_spec(std::string(argv[1]) + "/spec.toml");
  const auto branches = TableFolder(argv[1], spec).all_branches();
  const auto start = std::chrono::steady_clock::now();
  const auto content = make_stiffness_grid(spec, branches, "check");
  if (!content) return fmt::print("the table has too few states for a grid\n"), 1;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  fmt::print("made in {:.2f} s, {} kB\n", seconds.count(), to_bytes(*content).size() / 1024);
  for (const auto& patch : content->patches)
    fmt::print("{} x {} nodes from column {}{}\n", patch.columns, patch.rows, patch.first_column,
               patch.regularised ? ", regularised" : "");
  if (argc > 2) {
    std::ifstream file(argv[2], std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    GridContent same = *content;
    same.origin.program = grid_from_bytes(bytes, argv[2]).origin.program;
    fmt::print("{} is {}this table's grid\n", argv[2], to_bytes(same) == bytes ? "" : "not ");
  }
  compare_at_random(spec, branches, *content);
  return 0;
}
