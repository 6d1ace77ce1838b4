// Steps of samples, of functions that are known between them.
#include "sweep/accurate_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "numeric/hermite.h"
#include "table/branch.h"

namespace rheocyte::accurate_step_test {
namespace {

/// The logarithm of c^2 f(c), with its slope.
using Function = std::function<double(double)>;

SamplePoint sample(const Function& log_f, double u) {
  const double h = 1e-4;
  const auto value = [&](double at) { return 2 * at + log_f(std::exp(at)); };
  return {u, value(u), (value(u + h) - value(u - h)) / (2 * h)};
}

/// Of the polynomial in c through the samples around the last interval.
double error_in_last_interval(const Function& log_f, const std::vector<SamplePoint>& samples) {
  const SamplePoint& origin = samples[samples.size() - 2];
  const auto place = [&](std::size_t i) { return std::expm1(samples[i].place - origin.place); };
  std::vector<double> places, values, slopes;
  for (const std::size_t i : places_around(samples.size(), place, samples.size() - 2, samples_around)) {
    places.push_back(place(i));
    values.push_back(samples[i].value - 2 * (samples[i].place - origin.place));
    slopes.push_back((samples[i].slope - 2) / (1 + places.back()));
  }
  const HermitePolynomial polynomial(places, values, slopes);
  double greatest = 0;
  for (int k = 1; k < 20; ++k) {
    const double u = origin.place + (samples.back().place - origin.place) * k / 20;
    const double found = polynomial.at(std::expm1(u - origin.place)).value + 2 * (u - origin.place);
    greatest = std::max(greatest, std::abs(found - sample(log_f, u).value));
  }
  return greatest;
}

/// Takes samples from u = 0 to `end` as a branch does, and returns the greatest error of the dense output and their
/// number.
std::pair<double, int> follow(const Function& log_f, double end, double wanted) {
  std::vector<SamplePoint> samples{sample(log_f, 0), sample(log_f, 0.7)};
  double greatest = 0;
  for (double h = 0.7; samples.back().place < end;) {
    const double before = samples.back().place, to = std::min(before + h, end);
    samples.push_back(sample(log_f, to));
    const double step = accurate_step(samples, {2}, wanted, 1);
    h = std::min(0.75 * step, 0.9);
    if (to - before > 1.1 * step)
      samples.pop_back();
    else
      greatest = std::max(greatest, error_in_last_interval(log_f, samples));
  }
  return {greatest, int(samples.size())};
}

TEST(AccurateStep, OfFunctionsWithASingularityBehindTheirEndTheErrorIsWhatIsWanted) {
  // In the compliance c = e^u, from 1 to the end; the singularities lie at c = 55 and 50 +- 12 i.
  const Function pole = [](double c) { return -std::log1p(-c / 55); };
  const Function pair = [](double c) { return std::log1p(300 / ((c - 50) * (c - 50) + 144)); };
  const Function root = [](double c) { return -std::sqrt(1 - c / 55); };
  for (const Function& log_f : {pole, pair, root}) {
    const double end = std::log(50.0);
    const auto [error, count] = follow(log_f, end, 3e-5);
    EXPECT_LT(error, 1e-4) << "times three";
    EXPECT_LT(count, 24);
    EXPECT_LT(follow(log_f, end, 3e-7).first, 1e-6);
  }
}

TEST(AccurateStep, OfAPowerItIsTheLimit) {
  const std::vector<SamplePoint> samples{{0, 1, 2}, {1, 3, 2}, {2, 5, 2}};
  EXPECT_EQ(accurate_step(samples, {2}, 1e-8, 1.5), 1.5);
}

TEST(AccurateStep, AJumpIsMuchTooFar) {
  const std::vector<SamplePoint> samples{{0, 1, 2}, {1, 3, 2}, {2, 6, 2}};
  EXPECT_LE(accurate_step(samples, {2}, 1e-5, 1.5), 0.75);
}

}  // namespace
}  // namespace rheocyte::accurate_step_test
