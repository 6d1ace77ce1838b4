// Fits the law of an added ellipse in src/infer/added_ellipse.cc: ellipse_law DIR [SHAPES]
//
// Cells of the table in DIR get an added ellipse of random size; area and c_3 of the smooth outlines before and after
// are compared. Prints the coefficients as they stand in the source, and how well they describe the shapes.
#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "bare_branches.h"
#include "infer/added_ellipse.h"
#include "numeric/dense_solve.h"
#include "numeric/quantile.h"
#include "program.h"
#include "shape/outline_shape.h"
#include "synth/branch_shapes.h"
#include "synth/outline.h"
#include "table/grid_by_asymmetry.h"
#include "table/grid_from_branches.h"

namespace {

using namespace rheocyte;

constexpr double min_deformation = 3e-4, max_deformation = 0.1, max_ellipse = 0.25;
constexpr int second_mode = int(ShapeFeature::first_mode), third_mode = second_mode + 1;

/// An outline with its ellipse, and what is to be added to ln|c_3| and to ln(area) to be without it.
struct Changed {
  LongOutline outline;
  double log_mode_3 = 0, log_area = 0;
};

/// c_2 of the table's cells over ln(area) and ln|c_3|.
StiffnessGrid modes_2(const TableSpec& spec, const std::vector<SampledBranch>& branches) {
  const GridContent content = make_stiffness_grid(spec, branches, "").value();
  return StiffnessGrid(grids_by_asymmetry(StiffnessGrid(content), ShapeGrid(content.shapes.value())).value().mode_2);
}

std::vector<Changed> change_shapes(const CellShapes& shapes, const StiffnessGrid& modes_2, const TableSpec& spec,
                                   int count) {
  CellRandom random(3, 0, Purpose::place);
  const double width = channel_flow_of(spec.base).width_um;
  std::vector<Changed> all;
  while (static_cast<int>(all.size()) < count) {
    const auto found = random_shape(shapes, spec, random, min_deformation, max_deformation);
    if (!found) continue;
    const double ellipse = random.uniform() < 0.5 ? 0 : max_ellipse * random.uniform();
    const Eigen::MatrixX2d outline = silhouette(found->meridian), longer = with_ellipse(outline, ellipse);
    const ShapeVector before = shape_vector(outline_shape(outline)), after = shape_vector(outline_shape(longer));
    if (!(before(third_mode) * after(third_mode) > 0)) continue;
    const double log_area = std::log(found->area_um2) + after(0) - before(0),
                 log_mode_3 = std::log(std::abs(after(third_mode)));
    std::array<GridAnswer, 1> model;
    modes_2.answer({&log_area, 1}, {&log_mode_3, 1}, model);
    if (model[0].reason != NoAnswer::none) continue;
    all.push_back(
        {{after(second_mode) - model[0].log_stiffness, std::exp(log_mode_3), log_area - 2 * std::log(width / 2)},
         std::log(before(third_mode) / after(third_mode)),
         before(0) - after(0)});
  }
  return all;
}

auto as_row(const EllipseLaw& numbers) { return Eigen::RowVectorXd::Map(numbers.data(), Eigen::Index(numbers.size())); }

EllipseLaw fitted(const std::vector<Changed>& all, double Changed::*member) {
  const auto rows = Eigen::Index(all.size());
  Eigen::MatrixXd matrix(rows, Eigen::Index(EllipseLaw().size()));
  Eigen::VectorXd wanted(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Changed& one = all[std::size_t(row)];
    matrix.row(row) = as_row(ellipse_terms(one.outline));
    wanted(row) = one.*member;
  }
  EllipseLaw law;
  Eigen::VectorXd::Map(law.data(), Eigen::Index(law.size())) = least_squares(matrix, wanted);
  return law;
}

void print(const char* name, const EllipseLaw& law) {
  fmt::print("constexpr EllipseLaw {}{{", name);
  for (std::size_t i = 0; i < law.size(); ++i) fmt::print("{}{:.6g}", i ? ", " : "", law[i]);
  fmt::print("}};\n");
}

void tell(const std::vector<Changed>& all, const char* what, const EllipseLaw& law, double Changed::*member) {
  for (const bool round : {true, false}) {
    std::vector<double> before, left;
    for (const Changed& one : all) {
      if ((one.log_area == 0) != round) continue;
      before.push_back(std::abs(one.*member));
      left.push_back(
          std::abs(one.*member - std::inner_product(law.begin(), law.end(), ellipse_terms(one.outline).begin(), 0.0)));
    }
    const auto at = [](const std::vector<double>& v, double share) { return 100 * quantile(v, share); };
    fmt::print(stderr, "{}, {}: {:.2f} % (95 %: {:.2f} %), with the law {:.2f} % ({:.2f} %)\n", what,
               round ? "as the model" : "elongated", at(before, 0.5), at(before, 0.95), at(left, 0.5), at(left, 0.95));
  }
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("ellipse_law DIR [SHAPES]\n"), 2;
  const TableSpec spec = read_table_spec(std::string(argv[1]) + "/spec.toml");
  std::vector<SampledBranch> branches = bare_branches(TableFolder(argv[1], spec));
  const ChannelFlow flow = channel_flow_of(spec.base);
  const StiffnessGrid grid = modes_2(spec, branches);
  const BranchShapes shapes(std::move(branches), {flow, flow, false});
  const auto all = change_shapes(shapes, grid, spec, argc > 2 ? std::atoi(argv[2]) : 4000);
  const EllipseLaw mode_3 = fitted(all, &Changed::log_mode_3), area = fitted(all, &Changed::log_area);
  print("mode_3_law", mode_3);
  print("area_law", area);
  tell(all, "c_3", mode_3, &Changed::log_mode_3);
  tell(all, "area", area, &Changed::log_area);
  return 0;
}
