// How honest and how sharp the stated error of every number of a state is: random cells of all kinds at wanted
// accuracies of 1e-2 to 1e-4, each against its state on the finest resolution.
//
//     build/bench_number_errors tube|square|off-axis [COUNT [SEED]]          a summary, number by number
//     build/bench_number_errors values tube|square|off-axis [COUNT [SEED]]   a row for each number of each state, with
//     its value on each resolution
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "numeric/quantile.h"
#include "program.h"
#include "random_cells.h"
#include "solve/resolved_branch.h"
#include "state/state_measures.h"

namespace {

using namespace rheocyte;

constexpr double wanted_accuracies[] = {1e-2, 1e-3, 1e-4};
/// Differences below this fraction of a number are rounding and the tolerance of Newton's method.
constexpr double fraction_of_rounding = 3e-9;

/// A number of one state, and what it is on the finest resolution.
struct Compared {
  int cell;
  double accuracy;
  const StateMeasure* measure;
  std::vector<double> values;  ///< coarse to fine
  double stated, finest, error_of_finest;

  double true_error() const { return std::abs(values.back() - finest); }
  double size() const { return std::max(std::abs(finest), std::abs(values.back())); }
};

Problem random_problem(std::string_view where, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Problem problem = bench::random_solid(where == "tube" ? Section::tube : Section::square, random);
  const double kind = uniform(random), stiffness = problem.bulk.shear_modulus * problem.radius_ratio;
  if (where == "off-axis") {
    problem.offset = (0.9 - problem.radius_ratio) * uniform(random);
    if (problem.offset <= 0.01) problem.offset = 0.05;
  } else if (kind < 0.15) {
    problem.bulk = {.law = BulkLaw::none};
    problem.cortex = {CortexLaw::neo_hookean, 2 * stiffness, 0.3 * stiffness};
  } else if (kind < 0.3) {
    problem.cortex.bending = 0.002 * stiffness * problem.radius_ratio * problem.radius_ratio;
  } else if (kind < 0.45) {
    problem.bulk.rest_stretch = 1 + 0.1 * uniform(random);
  } else if (kind < 0.6) {
    problem.liquid.reynolds = 0.5 * uniform(random);
  }
  return problem;
}

int degree_of(const Ladder& ladder) { return ladder.rungs.back().discrete->resolution().degree; }

/// Of a tube at an accuracy that only rounding limits, of a duct one degree above the others.
Ladder finest(const Problem& problem, int degree) {
  if (!is_duct(problem.section)) return bench::climbed(problem, 1e-8);
  Ladder ladder = bench::climbed(problem, 1e-12, degree);
  return !ladder.rungs.empty() && degree_of(ladder) == degree ? ladder : Ladder{};
}

std::vector<Compared> compared(int cell, const Problem& problem) {
  std::vector<Compared> all;
  std::vector<std::pair<double, Ladder>> ladders;
  int degree = 6;
  for (const double accuracy : wanted_accuracies) {
    if (is_duct(problem.section) && accuracy < 5e-4) continue;
    Ladder ladder = bench::climbed(problem, accuracy);
    if (ladder.rungs.empty()) return {};
    degree = std::max(degree, degree_of(ladder) + 1);
    ladders.emplace_back(accuracy, std::move(ladder));
  }
  const Ladder fine = finest(problem, degree);
  if (fine.rungs.empty()) return {};
  const StateNumbers fine_errors = fine.errors();
  for (const auto& [accuracy, ladder] : ladders) {
    const StateNumbers errors = ladder.errors();
    for (const StateMeasure& measure : state_measures) {
      if (std::isnan(measure.value(fine.numbers.back()))) continue;
      Compared number{cell,
                      accuracy,
                      &measure,
                      {},
                      measure.value(errors),
                      measure.value(fine.numbers.back()),
                      measure.value(fine_errors)};
      for (const StateNumbers& rung : ladder.numbers) number.values.push_back(measure.value(rung));
      all.push_back(std::move(number));
    }
  }
  return all;
}

void print(const Compared& number) {
  fmt::print("{},{:g},{},{:.3e},{:.10g},{:.3e},{:.10g}\n", number.cell, number.accuracy, number.measure->name,
             number.stated, number.finest, number.error_of_finest, fmt::join(number.values, ","));
  std::fflush(stdout);
}

/// Of some numbers how their errors compare with what was stated.
struct Honesty {
  std::vector<double> true_over_stated;

  /// What the finest state states itself, several times its true error, is at most one and a half times the difference:
  /// else it does not give the true error.
  void add(const Compared& number) {
    const double error = number.true_error();
    if (error <= fraction_of_rounding * number.size() || number.error_of_finest > 1.5 * error) return;
    true_over_stated.push_back(error / number.stated);
  }
  std::ptrdiff_t above(double limit) const {
    return std::ranges::count_if(true_over_stated, [&](double ratio) { return ratio > limit; });
  }
  void print(std::string_view name) const {
    if (true_over_stated.empty()) return;
    fmt::print("| {} | {} | {:.1f} | {:.2f} | {:.2f} | {} | {} |\n", name, true_over_stated.size(),
               1 / quantile(true_over_stated, 0.5), quantile(true_over_stated, 0.95),
               *std::ranges::max_element(true_over_stated), above(1), above(1.5));
  }
};

void print_summary(const std::vector<Compared>& all) {
  fmt::print("| number | told | stated / true, median | true / stated, 95 % | at most | above 1 | above 1.5 |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  Honesty of_all;
  for (const Compared& number : all) of_all.add(number);
  for (const StateMeasure& measure : state_measures) {
    Honesty of_this;
    for (const Compared& number : all)
      if (number.measure == &measure) of_this.add(number);
    of_this.print(measure.name);
  }
  of_all.print("all");
}

}  // namespace

int rheocyte::measure(int count, char** words) {
  std::vector<std::string_view> given(words + 1, words + count);
  const bool wants_values = !given.empty() && given.front() == "values";
  if (wants_values) given.erase(given.begin());
  if (given.empty()) {
    fmt::print(stderr, "bench_number_errors [values] tube|square|off-axis [COUNT [SEED]]\n");
    return 2;
  }
  const auto number = [&](std::size_t i, int otherwise) {
    return i < given.size() ? std::atoi(given[i].data()) : otherwise;
  };
  std::mt19937 random(unsigned(number(2, 1)));
  std::vector<Compared> all;
  for (int cell = 0; cell < number(1, 20);) {
    const std::vector<Compared> numbers = compared(cell, random_problem(given.front(), random));
    if (numbers.empty()) continue;  // beyond the end of its branch
    ++cell;
    if (wants_values) std::ranges::for_each(numbers, print);
    all.insert(all.end(), numbers.begin(), numbers.end());
  }
  if (!wants_values) print_summary(all);
  return 0;
}
