// What one Newton iteration in the square channel costs, by polynomial degree, and what a whole state costs. Processor
// times of one thread; `gflop/s` of a product of large matrices in the same run says what the machine can do. How many
// threads a factorisation can use is counted: its operations over those that are done one after the other when threads
// take its tasks as they do (a list schedule), by the operations of each task; in the end without a limit of threads.
//
//   bench_duct            the tables of iterations and of counted parallelism, then six states
#include "solve/duct.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <deque>
#include <map>

#include "fem/nested_order.h"
#include "solve/stationary.h"

namespace {

using namespace rheocyte;

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Seconds of an action, the least of some runs.
template <class Action>
double seconds(int runs, const Action& action) {
  double least = 1e300;
  for (int run = 0; run < runs; ++run) {
    const double start = processor_seconds();
    action();
    least = std::min(least, processor_seconds() - start);
  }
  return least;
}

/// r0 = 6 um, neo-Hookean, in the channel of 20 um at 0.04 ul/s of 15 mPa s.
Problem standard_cell(double young_modulus_kPa) {
  Problem problem;
  problem.section = Section::square;
  problem.radius_ratio = 0.6;
  problem.bulk.shear_modulus = 1e3 * young_modulus_kPa / 3 / 150;
  return problem;
}

void print_iteration(int degree) {
  const Problem problem = standard_cell(4);
  std::unique_ptr<DuctDiscrete> discrete;
  const double set_up =
      seconds(1, [&] { discrete = std::make_unique<DuctDiscrete>(problem, DuctSubdivision{}, degree); });
  DuctSystem& system = discrete->system();
  VectorXd x = system.sphere(), r;
  const int runs = degree < 6 ? 3 : 1;
  const double tangent = seconds(runs, [&] { r = system.linearise(problem, x).value; });
  const double residual = seconds(runs, [&] { system.residual(problem, x); });
  const double solve = seconds(runs, [&] { system.solve(r); });
  fmt::print("| {} | {} | {} | {:.2g} | {:.2g} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", degree,
             discrete->space().elements().size(), discrete->space().unknowns(), system.factorisation_flops(),
             system.factor_entries(), set_up, tangent, residual, solve);
}

/// The operations of a task, and what is possible once it is done.
struct CountedTask {
  double flops = 0;
  int rank = 0, joined = 0;  ///< a subdomain that is begun once no more than this one's tasks are left
};

/// Operations one after the other when so many threads share a factorisation, its subdomains cut into blocks or not.
double flops_in_a_row(const NestedLU<float>& lu, int threads, bool is_cut = true) {
  using LU = NestedLU<float>;
  const std::vector<LU::Size> sizes = lu.sizes();
  std::vector<int> whole(sizes.size(), -1), left(sizes.size(), 1), parts_left(sizes.size(), 2);
  for (int i = 0; i < int(sizes.size()); ++i)
    for (const int part : sizes[i].parts)
      if (part >= 0) whole[part] = i;
  std::map<int, std::deque<CountedTask>> waiting;
  std::multimap<double, CountedTask> running;  // by their ends
  for (const int e : lu.elements())
    waiting[LU::rank_of_elements].push_back(
        {elimination_flops(sizes[e].eliminated, sizes[e].remaining), LU::rank_of_elements, e});
  const auto is_done = [&](const CountedTask& task) {
    const auto& [parts, eliminated, remaining] = sizes[task.joined];
    const double f = eliminated, o = remaining;
    if (task.rank == LU::rank_of_joins) {
      const double at_once = is_cut ? double(LU::columns_at_once(remaining)) : o;
      for (double from = 0; from < o; from += at_once, ++left[task.joined])
        waiting[LU::rank_of_blocks].push_back(
            {(2 * f * f + 2 * f * o) * std::min(at_once, o - from), LU::rank_of_blocks, task.joined});
    }
    if (--left[task.joined] > 0 || whole[task.joined] < 0 || --parts_left[whole[task.joined]] > 0) return;
    const double n = sizes[whole[task.joined]].eliminated;
    waiting[LU::rank_of_joins].push_back({n * n * n * 2 / 3, LU::rank_of_joins, whole[task.joined]});
  };
  double now = 0;
  for (;;) {
    while (int(running.size()) < threads && !waiting.empty()) {
      const auto first = waiting.begin();
      running.emplace(now + first->second.front().flops, first->second.front());
      first->second.pop_front();
      if (first->second.empty()) waiting.erase(first);
    }
    if (running.empty()) return now;
    now = running.begin()->first;
    const CountedTask task = running.begin()->second;
    running.erase(running.begin());
    is_done(task);
  }
}

void print_parallelism(int degree) {
  DuctDiscrete discrete(standard_cell(4), DuctSubdivision{}, degree);
  const NestedLU<float>& lu = discrete.system().factors();
  fmt::print("| {} |", degree);
  for (const int threads : {2, 4, 8, 1000}) fmt::print(" {:.2f} |", lu.flops() / flops_in_a_row(lu, threads));
  fmt::print(" {:.2f} |\n", lu.flops() / flops_in_a_row(lu, 1000, false));
}

void print_state(double young_modulus_kPa, double accuracy) {
  Problem problem = standard_cell(young_modulus_kPa);
  problem.accuracy = accuracy;
  StationaryState state;
  const double s = seconds(1, [&] { state = solve_stationary(problem); });
  fmt::print("| {} | {:g} | {:.7f} | {:.1e} | {} | {} | {} | {:.2f} |\n", young_modulus_kPa, accuracy,
             state.deformation_side, state.estimated_error, state.statistics.degree, state.statistics.newton_iterations,
             state.statistics.factorisations, s);
  std::fflush(stdout);
}

}  // namespace

int main() {
  const MatrixXd a = MatrixXd::Random(1000, 1000), b = MatrixXd::Random(1000, 1000);
  MatrixXd c(1000, 1000);
  fmt::print("gflop/s {:.1f}\n\n", 2 / seconds(5, [&] { c.noalias() = a * b; }));
  fmt::print("| p | hexahedra | unknowns | flops | L + U | set-up (s) | tangent (s) | residual (s) | solve (s) |\n");
  for (const int degree : {3, 4, 5, 6}) print_iteration(degree);
  fmt::print("\n| p | parallelism of 2 threads | of 4 | of 8 | of any number | and with whole subdomains |\n");
  for (const int degree : {2, 3, 4, 5, 6}) print_parallelism(degree);
  fmt::print("\n| E (kPa) | accuracy | d | estimated | degree | iterations | factorisations | time (s) |\n");
  for (const double accuracy : {1e-2, 1e-3}) {
    for (const double modulus : {8.0, 4.0, 2.5}) print_state(modulus, accuracy);
  }
}
