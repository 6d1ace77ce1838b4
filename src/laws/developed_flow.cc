#include "laws/developed_flow.h"

#include <numbers>

namespace rheocyte {
namespace {

/// With the shear rate g at the wall as the parameter, everything is an integral over rates of the stress tau(g)
/// (eq:developed): no stress has to be inverted for it.
class NumericFlow {
 public:
  explicit NumericFlow(const Liquid& liquid) : liquid_(liquid) {}

  double stress(double g) const { return viscosity(liquid_, g * g) * g; }

  /// (g - int_0^g (tau / tau_g)^3) / 3
  double mean_speed(double g) const {
    const double wall = stress(g);
    return (g - integral(0, g, [&](double rate) { return std::pow(stress(rate) / wall, 3); })) / 3;
  }
  /// g - r g_r - int_{g_r}^g tau / tau_g, where tau(g_r) = r tau_g
  double velocity(double g, double r) const {
    if (r <= 0) return g - integral(0, g, [&](double rate) { return stress(rate) / stress(g); });
    const double wall = stress(g), inner = rate_of([&](double rate) { return stress(rate); }, r * wall, r * g);
    return g - r * inner - integral(inner, g, [&](double rate) { return stress(rate) / wall; });
  }

  double wall_rate_of_stress(double wall) const {
    return rate_of([&](double rate) { return stress(rate); }, wall, wall / stress(1));
  }
  double wall_rate_of_speed(double speed) const {
    return rate_of([&](double rate) { return mean_speed(rate); }, speed, 4 * speed);
  }

 private:
  /// Trapezoidal rule in t, rate = from + (to - from) / (1 + exp(-pi sinh t)): steep or singular ends do no harm.
  template <class Function>
  static double integral(double from, double to, const Function& f) {
    constexpr double step = 1.0 / 16;
    constexpr int end = 52;
    double sum = 0;
    for (int i = -end; i <= end; ++i) {
      const double t = i * step;
      const double fraction = 1 / (1 + std::exp(-std::numbers::pi * std::sinh(t)));
      const double weight =
          std::numbers::pi * std::cosh(t) * fraction / (1 + std::exp(std::numbers::pi * std::sinh(t)));
      sum += weight * f(from + (to - from) * fraction);
    }
    return (to - from) * step * sum;
  }

  /// Where a rising function of rates has a value: the secant method in logarithms, in which it is nearly straight.
  template <class Function>
  static double rate_of(const Function& f, double value, double guess) {
    double x = std::log(guess), y = std::log(f(guess) / value), before = x + 0.1;
    double y_before = std::log(f(std::exp(before)) / value);
    for (int i = 0; i < 100 && y != 0 && y != y_before; ++i) {
      const double next = x - y * (x - before) / (y - y_before);
      before = x;
      y_before = y;
      x = next;
      if (std::abs(x - before) < 1e-10) break;  // the next step would be below rounding
      y = std::log(f(std::exp(x)) / value);
    }
    return std::exp(x);
  }

  Liquid liquid_;
};

/// Shear rate of a power law at the wall, at mean speed 1.
double wall_rate(double n) { return (3 * n + 1) / n; }

double closed_exponent(const Liquid& liquid) { return liquid.law == LiquidLaw::newtonian ? 1 : liquid.exponent; }

}  // namespace

double undisturbed_pressure_gradient(const Liquid& liquid, double mean_speed) {
  const double n = closed_exponent(liquid);
  if (is_power_law(liquid.law)) return 2 * liquid.viscosity * std::pow(wall_rate(n) * mean_speed, n);
  const NumericFlow flow(liquid);
  return 2 * flow.stress(flow.wall_rate_of_speed(mean_speed));
}

double undisturbed_mean_speed(const Liquid& liquid, double pressure_gradient) {
  const double n = closed_exponent(liquid), wall_stress = pressure_gradient / 2;
  if (is_power_law(liquid.law)) return std::pow(wall_stress / liquid.viscosity, 1 / n) / wall_rate(n);
  const NumericFlow flow(liquid);
  return flow.mean_speed(flow.wall_rate_of_stress(wall_stress));
}

double undisturbed_velocity(const Liquid& liquid, double r) {
  const double n = closed_exponent(liquid);
  if (is_power_law(liquid.law)) return (3 * n + 1) / (n + 1) * (1 - std::pow(r, (n + 1) / n));
  const NumericFlow flow(liquid);
  return flow.velocity(flow.wall_rate_of_speed(1), r);
}

double stress_at_rate(const Liquid& liquid, double rate) {
  if (is_power_law(liquid.law)) return liquid.viscosity * std::pow(rate, closed_exponent(liquid));
  return NumericFlow(liquid).stress(rate);
}

}  // namespace rheocyte
