// How long a session takes to answer cases near an earlier one, and cells that are far too soft.
//
//     build/bench_session
//
// Processor times. Every answer is compared with the one from the sphere.
#include "solve/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <vector>

#include "case/scales.h"
#include "numeric/quantile.h"

namespace rheocyte {
namespace {

constexpr double tube_um = 10.94, rate_ul_per_s = 0.04, viscosity_mPas = 15;

double processor_ms() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

/// What a user moves.
struct Sliders {
  double E_kPa = 4.58, radius_um = 6, rate = 1, tension_mN_per_m = 0;
};

Problem problem_at(const Sliders& s, double accuracy) {
  const double R = tube_um * 1e-6, U = s.rate * rate_ul_per_s * 1e-9 / (M_PI * R * R),
               S = viscosity_mPas * 1e-3 * U / R;
  Problem problem;
  problem.radius_ratio = s.radius_um / tube_um;
  problem.bulk.law = BulkLaw::linear;
  problem.bulk.c1_fraction = 0;
  problem.bulk.shear_modulus = 1e3 * s.E_kPa / (3 * S);
  problem.cortex.tension = 1e-3 * s.tension_mN_per_m / (S * R);
  problem.accuracy = accuracy;
  return problem;
}

void small_steps(double accuracy) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(-0.03, 0.03);
  Sliders sliders{.tension_mN_per_m = 0.2};
  Session session;
  std::vector<double> warm, cold;
  double greatest = 0;
  session.solve(problem_at(sliders, accuracy));
  for (int i = 0; i < 200; ++i) {
    double* moved[] = {&sliders.E_kPa, &sliders.radius_um, &sliders.rate, &sliders.tension_mN_per_m};
    *moved[i % 4] *= 1 + step(random);
    const Problem problem = problem_at(sliders, accuracy);
    const double start = processor_ms();
    const StationaryState state = session.solve(problem);
    const double middle = processor_ms();
    const StationaryState anew = solve_stationary(problem);
    warm.push_back(middle - start);
    cold.push_back(processor_ms() - middle);
    greatest = std::max(greatest, std::abs(state.shape.deformation / anew.shape.deformation - 1));
  }
  fmt::print(
      "accuracy {:g}: {} of 200 warm, median {:.1f} ms (from the sphere {:.1f} ms); greatest difference {:.1e}; {:.0f} "
      "MB\n",
      accuracy, session.warm_starts(), median_of(warm), median_of(cold), greatest,
      double(session.memory_bytes()) * 1e-6);
}

void refusals() {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> times;
  int refused = 0;
  for (int i = 0; i < 40; ++i) {
    Sliders sliders{.E_kPa = std::pow(10, -2 + 1.3 * uniform(random)), .radius_um = 3.5 + 6 * uniform(random)};
    Problem problem = problem_at(sliders, 1e-4);
    if (i % 2) problem.bulk.law = BulkLaw::neo_hookean, problem.bulk.c1_fraction = 1;
    const double start = processor_ms();
    const StationaryState state = solve_stationary(problem);
    times.push_back(processor_ms() - start);
    refused += state.outcome.status != Status::converged;
    fmt::print("  r0 {:.2f} um, E {:.3f} kPa: {:6.0f} ms, {}, at {:.3f} of the compliance\n", sliders.radius_um,
               sliders.E_kPa, times.back(), name(state.outcome.status), state.outcome.reached);
  }
  fmt::print("{} of 40 refused, median {:.0f} ms, at most {:.0f} ms\n", refused, median_of(times),
             *std::max_element(times.begin(), times.end()));
}

}  // namespace
}  // namespace rheocyte

int main() {
  for (const double accuracy : {1e-3, 1e-4}) rheocyte::small_steps(accuracy);
  rheocyte::refusals();
}
