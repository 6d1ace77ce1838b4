// The sum of all parts, and its factors, do not depend on the number of threads; what ends the work leaves none behind.
#include "fem/assembled_system.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <stdexcept>

namespace rheocyte::assembled_system_test {
namespace {

constexpr int columns = 5, rows = 4;
constexpr int of_corner = 60, inside = 80;  ///< so many unknowns that fronts are condensed in several blocks

int corner_unknown(int i, int j, int k) { return of_corner * (i + (columns + 1) * j) + k; }

/// A grid of quadrilateral elements with random linear equations that are dominant enough to be regular.
class RandomGrid final : public AssembledSystem<double> {
 public:
  static constexpr int corners = of_corner * (columns + 1) * (rows + 1);
  static constexpr int unknowns = corners + inside * columns * rows;

  RandomGrid() : AssembledSystem(unknowns, 0) {
    std::vector<std::vector<int>> nodes;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        CoupledUnknowns element;
        for (const auto& [right, up] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
          for (int k = 0; k < of_corner; ++k) element.unknowns.push_back(corner_unknown(i + right, j + up, k));
        }
        for (int k = 0; k < inside; ++k) element.unknowns.push_back(corners + inside * (i + columns * j) + k);
        nodes.push_back({element.unknowns.front(), corner_unknown(i + 1, j, 0), corner_unknown(i, j + 1, 0),
                         corner_unknown(i + 1, j + 1, 0)});
        elements_.push_back(element);
      }
    }
    set_neighbours(nodes, 2, elements_);
    couple(elements_);
  }

  /// Which part throws, and which part makes the work stop; -1: none.
  int failing = -1, stopping = -1;
  mutable std::atomic<bool> stop = false;

  double cell_radius() const override { return 1; }
  double largest_displacement(const VectorXd&) const override { return 0; }
  void scale_displacement(double, VectorXd&) const override {}
  double stretch_change(const VectorXd&, const VectorXd&) const override { return 0; }
  std::size_t memory_bytes() const override { return factor_bytes(); }

 private:
  VectorXd loads(const Media&, const VectorXd&) override { return VectorXd::Constant(unknowns, 0.1); }
  double add_part(int part, const At& at, PartResidual& sum, PartWorkspace<double>& workspace) const override {
    if (part == failing) throw std::runtime_error("of a part");
    if (part == stopping) stop = true;
    std::mt19937 engine(part);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const std::vector<int>& of_part = elements_[part].unknowns;
    for (const int row : of_part) {
      for (const int column : of_part) {
        const double entry = uniform(engine) + (row == column ? 50 : 0);
        sum.add(row, entry * at.unknowns(column));
        if (at.want == Want::residual_and_tangent)
          workspace.matrix(workspace.place[row], workspace.place[column]) += entry;
      }
    }
    return 1 + part;
  }

  std::vector<CoupledUnknowns> elements_;
};

const Media media{};

/// What a system answers with so many threads, from a given vector.
struct Answers {
  VectorXd residual, linearised, solved;
  MatrixXd columns;

  Answers(RandomGrid& system, int threads) {
    const VectorXd x = VectorXd::LinSpaced(RandomGrid::unknowns, -1, 2);
    system.obey({nullptr, threads});
    const Residual of_x = system.residual(media, x);
    residual = of_x.value;
    EXPECT_EQ(of_x.min_det, 1);
    linearised = system.linearise(media, x).value;
    EXPECT_TRUE(system.has_factors());
    solved = system.solve(residual);
    columns = system.solve_columns(MatrixXd::Identity(RandomGrid::unknowns, 2));
  }
};

TEST(AssembledSystem, TheAnswersAreTheSameBitsForAnyNumberOfThreads) {
  RandomGrid system;
  ASSERT_GT(system.factorisation_flops(), 4e8) << "four threads have to be worth while";
  const Answers expected(system, 1);
  // Rounding of a well-conditioned matrix; the loads do not belong to it.
  const VectorXd x = VectorXd::LinSpaced(RandomGrid::unknowns, -1, 2);
  const VectorXd product = expected.residual - VectorXd::Constant(RandomGrid::unknowns, 0.1);
  EXPECT_LT((system.solve(product) - x).norm(), 1e-12 * x.norm());
  for (const int threads : {2, 4, 2, 1}) {
    const Answers answers(system, threads);
    EXPECT_EQ(answers.residual, expected.residual) << threads;
    EXPECT_EQ(answers.linearised, expected.linearised) << threads;
    EXPECT_EQ(answers.solved, expected.solved) << threads;
    EXPECT_EQ(answers.columns, expected.columns) << threads;
  }
}

TEST(AssembledSystem, AnExceptionInAPartReachesTheCallerAndTheNextWorkIsDoneAsEver) {
  RandomGrid system;
  const Answers expected(system, 1);
  const VectorXd x = VectorXd::LinSpaced(RandomGrid::unknowns, -1, 2);
  for (const int threads : {1, 2, 4}) {
    system.obey({nullptr, threads});
    for (const int part : {0, 11, 19}) {
      system.failing = part;
      EXPECT_THROW(system.residual(media, x), std::runtime_error);
      EXPECT_TRUE(system.has_factors()) << "a residual leaves them alone";
      EXPECT_THROW(system.linearise(media, x), std::runtime_error);
      EXPECT_FALSE(system.has_factors());
      system.failing = -1;
      EXPECT_EQ(Answers(system, threads).solved, expected.solved);
    }
  }
}

TEST(AssembledSystem, StopsInTheMiddleAndTheNextWorkIsDoneAsEver) {
  RandomGrid system;
  const Answers expected(system, 1);
  const VectorXd x = VectorXd::LinSpaced(RandomGrid::unknowns, -1, 2);
  for (const int threads : {1, 2, 4}) {
    for (const int part : {0, 11, 19}) {
      system.obey({&system.stop, threads});
      system.stopping = part;
      EXPECT_FALSE(system.linearise(media, x).value.allFinite());
      EXPECT_FALSE(system.has_factors());
      system.stopping = -1;
      system.stop = false;
      EXPECT_EQ(Answers(system, threads).solved, expected.solved);
    }
  }
}

}  // namespace
}  // namespace rheocyte::assembled_system_test
