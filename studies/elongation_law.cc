// Fits the law in src/infer/elongation_law.cc: elongation_law FILE [CELLS], FILE a table of elongated cells.
//
// Cells of the table at random places are compared with those of the same size and modulus under no tension. Prints the
// coefficients as they stand in the source, and how well they describe the cells.
#include "infer/elongation_law.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "numeric/cell_random.h"
#include "numeric/dense_solve.h"
#include "numeric/quantile.h"
#include "program.h"
#include "store/read_file.h"
#include "table/elongated_table.h"

namespace {

using namespace rheocyte;

/// What is to be added to ln|c_3| and to ln(area) of an outline to be that without the tension.
struct Changed {
  LongOutline outline;
  double log_mode_3 = 0, log_area = 0;
};

std::vector<Changed> change_cells(const ElongatedTable& table, std::size_t count) {
  constexpr int mode_2 = number_of(ElongatedMeasure::mode_2), mode_3 = number_of(ElongatedMeasure::mode_3);
  CellRandom random(3, 0, Purpose::place);
  const ElongatedCell least = table.least(), width = table.greatest() - least;
  const double half_width = table.origin().flow.width_um / 2;
  std::vector<Changed> all;
  while (all.size() < count) {
    const Eigen::Vector3d place(random.uniform(), random.uniform(), 0.02 + 0.98 * random.uniform());
    const ElongatedCell cell = least + width.cwiseProduct(place), round = table.without_elongation(cell);
    if (round(2) == 1) continue;  // it would not be stable
    const ElongatedState with = table.at(cell), without = table.at(round);
    all.push_back(
        {{with.value(mode_2) - without.value(mode_2), with.value(mode_3), with.log_area() - 2 * std::log(half_width)},
         std::log(without.value(mode_3) / with.value(mode_3)),
         without.log_area() - with.log_area()});
  }
  return all;
}

auto as_row(const ElongationLaw& numbers) {
  return Eigen::RowVectorXd::Map(numbers.data(), Eigen::Index(numbers.size()));
}

void fit(const std::vector<Changed>& all, const char* name, double Changed::*member) {
  const auto rows = Eigen::Index(all.size());
  Eigen::MatrixXd matrix(rows, Eigen::Index(ElongationLaw().size()));
  Eigen::VectorXd wanted(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    matrix.row(row) = as_row(elongation_terms(all[std::size_t(row)].outline));
    wanted(row) = all[std::size_t(row)].*member;
  }
  const Eigen::VectorXd law = least_squares(matrix, wanted);
  fmt::print("constexpr ElongationLaw {}{{", name);
  for (Eigen::Index i = 0; i < law.size(); ++i) fmt::print("{}{:.6g}", i ? ", " : "", law(i));
  fmt::print("}};\n");
  std::vector<double> before, left;
  for (Eigen::Index row = 0; row < rows; ++row) {
    before.push_back(std::abs(wanted(row)));
    left.push_back(std::abs(wanted(row) - matrix.row(row).dot(law)));
  }
  fmt::print(stderr, "{}: {:.2f} % (95 %: {:.2f} %), with the law {:.2f} % ({:.2f} %)\n", name,
             100 * quantile(before, 0.5), 100 * quantile(before, 0.95), 100 * quantile(left, 0.5),
             100 * quantile(left, 0.95));
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("elongation_law FILE [CELLS]\n"), 2;
  const ElongatedTable table(elongated_from_bytes(content_of_file(argv[1], largest_elongated), argv[1]));
  const auto all = change_cells(table, argc > 2 ? std::size_t(std::atoi(argv[2])) : 4000);
  fit(all, "mode_3_law", &Changed::log_mode_3);
  fit(all, "area_law", &Changed::log_area);
  return 0;
}
