#include "population/dose_response.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <vector>

#include "population/statistics_laws.h"

namespace rheocyte {
namespace {

/// How far beyond the doses an ec50 is looked for, and in how many steps.
constexpr double factor_beyond = 100;
constexpr int steps = 4000;

/// ln of the number = level of the session + slope * x, by least squares.
struct SessionLine {
  double slope = no_value, squares = 0;  ///< of x about the means of the sessions
  double residues = 0;
  double freedom = 0;
};

template <class X>
SessionLine line_through(std::span<const MeanAtDose> means, const X& x_of) {
  std::set<std::size_t> sessions;
  double squares = 0, products = 0, all = 0;
  for (const MeanAtDose& m : means) {
    if (!sessions.insert(m.session).second) continue;
    double x = 0, y = 0, count = 0;
    for (const MeanAtDose& other : means)
      if (other.session == m.session) x += x_of(other.dose), y += other.log_value, ++count;
    for (const MeanAtDose& other : means) {
      if (other.session != m.session) continue;
      const double dx = x_of(other.dose) - x / count, dy = other.log_value - y / count;
      squares += dx * dx, products += dx * dy, all += dy * dy;
    }
  }
  if (!(squares > 0)) return {};
  return {products / squares, squares, std::max(all - products * products / squares, 0.0),
          double(means.size()) - double(sessions.size()) - 1};
}

std::set<double> doses_of(std::span<const MeanAtDose> means) {
  std::set<double> doses;
  for (const MeanAtDose& m : means) doses.insert(m.dose);
  return doses;
}

void add_slope(std::span<const MeanAtDose> means, double level, DoseResponse& found) {
  std::vector<MeanAtDose> dosed(means.begin(), means.end());
  std::erase_if(dosed, [](const MeanAtDose& m) { return m.dose == 0; });
  if (doses_of(dosed).size() < 2) return;
  const SessionLine line = line_through(dosed, [](double dose) { return std::log10(dose); });
  found.slope_per_decade = line.slope;
  if (!(line.freedom > 0)) return;
  const double error = std::sqrt(line.residues / line.freedom / line.squares),
               reach = students_t_quantile(line.freedom, (1 + level) / 2) * error;
  found.slope_lower = line.slope - reach;
  found.slope_upper = line.slope + reach;
  found.p = students_t_beyond(line.freedom, line.slope / error);
}

void add_ec50(std::span<const MeanAtDose> means, double level, DoseResponse& found) {
  std::set<double> doses = doses_of(means);
  if (doses.size() < 3) return;
  doses.erase(0);
  const double first = std::log(*doses.begin() / factor_beyond), last = std::log(*doses.rbegin() * factor_beyond);
  const auto ec50_at = [&](int step) { return std::exp(first + (last - first) * step / steps); };
  const auto line_at = [&](int step) {
    const double ec50 = ec50_at(step);
    return line_through(means, [ec50](double dose) { return dose / (dose + ec50); });
  };
  std::vector<SessionLine> lines;
  for (int step = 0; step <= steps; ++step) lines.push_back(line_at(step));
  const auto best = std::ranges::min_element(lines, {}, &SessionLine::residues);
  const double freedom = best->freedom - 1;
  if (!(freedom > 0) || std::isnan(best->slope)) return;
  found.ec50 = ec50_at(int(best - lines.begin()));
  const double t = students_t_quantile(freedom, (1 + level) / 2),
               most = best->residues * (1 + t * t / freedom) + 1e-12 * best->squares;
  const auto is_alike = [&](const SessionLine& line) { return line.residues <= most; };
  const auto lower = std::ranges::find_if(lines, is_alike);
  const auto upper = std::ranges::find_if(lines.rbegin(), lines.rend(), is_alike);
  found.ec50_lower = lower == lines.begin() ? 0 : ec50_at(int(lower - lines.begin()));
  found.ec50_upper = upper == lines.rbegin() ? HUGE_VAL : ec50_at(int(upper.base() - lines.begin()) - 1);
  if (found.ec50_lower > 0 && std::isfinite(found.ec50_upper)) found.log_effect = best->slope;
}

}  // namespace

DoseResponse dose_response(std::span<const MeanAtDose> means, double level) {
  assert(std::ranges::all_of(means, [](const MeanAtDose& m) { return m.dose >= 0; }));
  DoseResponse found;
  add_slope(means, level, found);
  add_ec50(means, level, found);
  return found;
}

}  // namespace rheocyte
