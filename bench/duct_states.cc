// Whole states in the square channel, from the sphere: what they take, and whether their stated errors are honest.
//
//     build/bench_duct_states [ACCURACY [FIRST [LAST]]]   twenty fixed cells (or some of them); default 1e-3
//     build/bench_duct_states threads N [ACCURACY [FIRST [LAST]]]   the same with so many threads
//     build/bench_duct_states random [COUNT [SEED]]       random cells at 1e-3 against the same at 3e-5
//     build/bench_duct_states first [COUNT [SEED]]        random cells of more kinds: what degree 4 states, against
//     degree 6 build/bench_duct_states warm [ACCURACY [COUNT]]     small steps in a session, each against the answer
//     from the sphere
//
// Processor times, added over the threads; of the fixed cells wall times, too.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string_view>
#include <vector>

#include "numeric/quantile.h"
#include "random_cells.h"
#include "solve/session.h"
#include "solve/stationary.h"

namespace {

using namespace rheocyte;

struct Cell {
  double radius;  ///< r0 / h
  BulkLaw law;
  double exponent;  ///< of the liquid; 1: Newtonian
  double modulus;   ///< mu / S

  Problem problem(double accuracy) const {
    Problem problem;
    problem.section = Section::square;
    problem.radius_ratio = radius;
    problem.bulk = {.law = law, .shear_modulus = modulus};
    if (exponent < 1) problem.liquid = {.law = LiquidLaw::power_law, .exponent = exponent};
    problem.accuracy = accuracy;
    return problem;
  }
};

constexpr BulkLaw linear = BulkLaw::linear, neo_hookean = BulkLaw::neo_hookean, mooney = BulkLaw::mooney_rivlin;

/// From stiff cells to some that are near the end of their branch.
constexpr Cell cells[] = {
    {0.2, linear, 1, 3.2},    {0.2, neo_hookean, 0.6, 5.9}, {0.3, neo_hookean, 1, 2.8},    {0.3, linear, 0.6, 5},
    {0.3, mooney, 1, 28},     {0.4, linear, 1, 4.6},        {0.4, neo_hookean, 0.6, 3.7},  {0.4, mooney, 1, 14.5},
    {0.5, neo_hookean, 1, 5}, {0.5, linear, 0.8, 6},        {0.5, neo_hookean, 1, 37},     {0.6, linear, 1, 7},
    {0.6, mooney, 1, 14},     {0.7, neo_hookean, 1, 8.4},   {0.6, neo_hookean, 0.6, 3.78}, {0.7, linear, 0.6, 6.8},
    {0.7, mooney, 1, 37},     {0.8, mooney, 0.6, 7},        {0.8, linear, 1, 23},          {0.9, neo_hookean, 1, 25},
};

std::string_view name_of(BulkLaw law) {
  return law == linear ? "linear" : law == neo_hookean ? "neo-hookean" : "mooney-rivlin";
}

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of this process so far.
double max_memory_GB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024e-9;
}

/// The degrees on the way, and how many states each saw.
std::string degrees_of(const StationaryState& state) {
  std::string degrees;
  for (const BranchStep& step : state.branch) degrees += fmt::format("{}", step.degree);
  return degrees;
}

void print_cell(const Cell& cell) {
  fmt::print("| {} | {} | {} | {} ", cell.radius, name_of(cell.law), cell.exponent, cell.modulus);
  std::fflush(stdout);
}

void print_states(int threads, double accuracy, int first, int last) {
  fmt::print(
      "| r0/h | law | n | mu/S | d | estimated | degrees | iterations | factorisations | assembly (s) | factorisation "
      "(s) | time (s) | wall (s) |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<double> times, walls;
  for (int i = first; i < last; ++i) {
    const Cell& cell = cells[i];
    print_cell(cell);
    const double start = processor_seconds(), wall_start = wall_seconds();
    const StationaryState state = solve_stationary(cell.problem(accuracy), {}, {nullptr, threads});
    times.push_back(processor_seconds() - start);
    walls.push_back(wall_seconds() - wall_start);
    const SolveStatistics& s = state.statistics;
    fmt::print("| {:.6g} | {:.1e} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |{}\n", state.shape.deformation,
               state.estimated_error, degrees_of(state), s.newton_iterations, s.factorisations, s.assembly_s,
               s.factorisation_s, times.back(), walls.back(),
               state.outcome.status == Status::converged ? "" : fmt::format(" {}", name(state.outcome.status)));
    std::fflush(stdout);
  }
  fmt::print(
      "\naccuracy {:g}, threads {}: median {:.3f} s, at most {:.3f} s; wall: median {:.3f} s, at most {:.3f} s; {:.3f} "
      "GB\n",
      accuracy, threads, median_of(times), *std::ranges::max_element(times), median_of(walls),
      *std::ranges::max_element(walls), max_memory_GB());
}

/// d is about 3 a^2.1 / (mu/S)^2 in a Newtonian liquid and a third of that in a shear-thinning one.
Cell random_cell(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Cell cell{};
  cell.radius = 0.2 + 0.7 * uniform(random);
  cell.law = std::array{linear, neo_hookean, mooney}[std::size_t(3 * uniform(random))];
  cell.exponent = uniform(random) < 0.5 ? 1 : 0.6;
  const double d = 2e-4 * std::pow(150, uniform(random));
  cell.modulus = std::sqrt((cell.exponent < 1 ? 1 : 3) * std::pow(cell.radius, 2.1) / d);
  return cell;
}

void check_estimates(int count, unsigned seed) {
  constexpr double wanted = 1e-3, reference = 3e-5;
  std::mt19937 random(seed);
  std::vector<double> fractions;
  fmt::print("| r0/h | law | n | mu/S | d | estimated | true error | true / estimated | degrees |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  while (int(fractions.size()) < count) {
    const Cell cell = random_cell(random);
    const StationaryState state = solve_stationary(cell.problem(wanted));
    if (state.outcome.status != Status::converged) continue;  // beyond the end of its branch
    const StationaryState fine = solve_stationary(cell.problem(reference));
    const double error = std::abs(state.shape.deformation / fine.shape.deformation - 1);
    fractions.push_back(error / state.estimated_error);
    print_cell(cell);
    fmt::print("| {:.6g} | {:.1e} | {:.1e} | {:.2f} | {} / {} ({:.0e}) |\n", state.shape.deformation,
               state.estimated_error, error, fractions.back(), degrees_of(state), degrees_of(fine),
               fine.estimated_error);
    std::fflush(stdout);
  }
  const auto honest = std::ranges::count_if(fractions, [](double fraction) { return fraction < 2; });
  fmt::print("\n{} of {} below twice the stated error; at most {:.2f} times\n", honest, count,
             *std::ranges::max_element(fractions));
}

void check_first_estimates(int count, unsigned seed) {
  constexpr double not_reached = 1e-12;
  constexpr int last_degree = 6;
  std::mt19937 random(seed);
  fmt::print("| r0/h | n | d | margin | change of d | change of the margin | stated | true error |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  while (count > 0) {
    const Problem problem = bench::random_solid(Section::square, random);
    const Ladder ladder = bench::climbed(problem, not_reached, last_degree);
    if (ladder.rungs.empty()) continue;  // beyond the end of its branch
    Ladder first{ladder.rule};
    if (ladder.rungs.front().discrete->resolution().degree != 3 || std::ssize(ladder.rungs) <= last_degree - 3)
      continue;
    for (const std::size_t rung : {0, 1}) first.add(ladder.rungs[rung], ladder.numbers[rung]);
    const StateNumbers &coarse = ladder.numbers[0], &fine = ladder.numbers[1];
    const double d = ladder.deformation();
    fmt::print("| {:.2f} | {} | {:.4g} | {:.3f} | {:.1e} | {:.3f} | {:.1e} | {:.1e} |\n", problem.radius_ratio,
               problem.liquid.exponent, d, fine.stability_margin,
               std::abs(fine.shape.deformation - coarse.shape.deformation) / d,
               fine.stability_margin - coarse.stability_margin, first.estimated_error,
               std::abs(fine.shape.deformation - d) / d);
    std::fflush(stdout);
    --count;
  }
}

/// One number changed by at most three per cent.
void step(std::mt19937& random, int which, Problem& problem) {
  std::uniform_real_distribution<double> by(-0.03, 0.03);
  double* moved[] = {&problem.bulk.shear_modulus, &problem.radius_ratio, &problem.cortex.tension,
                     &problem.liquid.exponent};
  *moved[which % 4] *= 1 + by(random);
}

void print_warm_starts(double accuracy, int count) {
  std::mt19937 random(3);
  Problem problem = Cell{0.6, neo_hookean, 0.6, 4}.problem(accuracy);
  problem.cortex.tension = 0.2;
  Session session(std::size_t(512) << 20);
  session.solve(problem);
  std::vector<double> warm, cold;
  double max_difference = 0;
  fmt::print("| step | d | difference | degree | iterations | factorisations | warm (s) | from the sphere (s) |\n");
  for (int i = 0; i < count; ++i) {
    step(random, i, problem);
    const double start = processor_seconds();
    const StationaryState state = session.solve(problem);
    warm.push_back(processor_seconds() - start);
    const StationaryState anew = solve_stationary(problem);
    cold.push_back(processor_seconds() - start - warm.back());
    const double difference = std::abs(state.shape.deformation / anew.shape.deformation - 1);
    max_difference = std::max(max_difference, difference);
    fmt::print("| {} | {:.6g} | {:.1e} | {} | {} | {} | {:.2f} | {:.2f} |\n", i, state.shape.deformation, difference,
               state.statistics.degree, state.statistics.newton_iterations, state.statistics.factorisations,
               warm.back(), cold.back());
    std::fflush(stdout);
  }
  fmt::print(
      "\naccuracy {:g}: {} of {} warm, median {:.2f} s (from the sphere {:.2f} s); greatest difference {:.1e}; {:.0f} "
      "MB of factors\n",
      accuracy, session.warm_starts(), count, median_of(warm), median_of(cold), max_difference,
      double(session.memory_bytes()) * 1e-6);
}

}  // namespace

int main(int count, char** words) {
  const auto word = [&](int i, double otherwise) { return count > i ? std::atof(words[i]) : otherwise; };
  if (count > 1 && std::string_view(words[1]) == "random") {
    check_estimates(int(word(2, 30)), unsigned(word(3, 1)));
  } else if (count > 1 && std::string_view(words[1]) == "first") {
    check_first_estimates(int(word(2, 30)), unsigned(word(3, 1)));
  } else if (count > 1 && std::string_view(words[1]) == "warm") {
    print_warm_starts(word(2, 1e-3), int(word(3, 12)));
  } else if (count > 1 && std::string_view(words[1]) == "threads") {
    print_states(int(word(2, 1)), word(3, 1e-3), int(word(4, 0)), int(word(5, std::size(cells))));
  } else if (count > 1 && word(1, 0) <= 0) {
    fmt::print(stderr,
               "bench_duct_states [threads N] [ACCURACY [FIRST [LAST]]], random or first [COUNT [SEED]], or warm "
               "[ACCURACY [COUNT]]\n");
    return 2;
  } else {
    print_states(1, word(1, 1e-3), int(word(2, 0)), int(word(3, std::size(cells))));
  }
}
