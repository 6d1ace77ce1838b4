#include "population/fit_cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "numeric/dense_solve.h"
#include "numeric/no_value.h"
#include "population/likelihood_maximum.h"
#include "population/statistics_laws.h"

namespace rheocyte {
namespace {

constexpr double least_radius_spread = 0.003, greatest_radius_spread = 1, least_modulus_spread = 0.01,
                 greatest_modulus_spread = 1.5, greatest_artanh = 2.5;
/// Of the mean of ln r0 and ln E, by a standard deviation of the elongation.
constexpr double steepest = 1;
/// Nodes are placed again until the cells move less than this fraction of their spreads: far less than the nodes reach.
constexpr double settled_fraction = 0.05;
constexpr int most_placings = 6;
/// Where gates keep less the likelihood has no parabola.
constexpr double parabolic_kept = 0.3;
/// A spread below this fraction of a single image's error is not known by the parabola.
constexpr double least_fraction_of_error = 0.5;
constexpr int profile_steps = 6;
constexpr double profile_tolerance = 0.01;  ///< in standard errors

struct Weighted {
  double value, count;
};

double weighted_median(std::vector<Weighted> values) {
  std::ranges::sort(values, {}, &Weighted::value);
  double total = 0, sum = 0;
  for (const auto& v : values) total += v.count;
  for (const auto& v : values) {
    sum += v.count;
    if (sum >= total / 2) return v.value;
  }
  return no_value;
}

/// Where the search begins: the median cell, seen through the map of the median event.
struct Start {
  explicit Start(const Sample& sample) {
    std::vector<Weighted> areas, measures, viscosities;
    double sum = 0, square = 0, seen = 0;
    const double all = sample.events();
    for (const EventGroup& group : sample.groups) {
      for (const SampleEvent& e : group.events) {
        areas.push_back({e.log_area, e.count});
        measures.push_back({e.measure, e.count});
        viscosities.push_back({e.log_viscosity, e.count});
        sum += e.count * e.log_area, square += e.count * e.log_area * e.log_area;
        seen += e.count;
      }
      if (!map && seen >= all / 2) map = group.map.get();
    }
    log_viscosity = weighted_median(std::move(viscosities));
    measure = weighted_median(std::move(measures));
    const auto radii = map->log_radii();
    u = std::clamp(0.5 * (weighted_median(std::move(areas)) - std::log(std::numbers::pi)), radii.lower, radii.upper);
    const double variance = std::max(square / all - sum * sum / all / all, 0.0);
    spread = std::clamp(std::sqrt(variance) / 2, 2 * least_radius_spread, greatest_radius_spread / 2);
    x = height_of(measure);
    noise = std::sqrt(map->at(u, x).measure_variance);
  }

  double height_of(double wanted) const {
    auto [low, high] = map->heights();
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      (map->at(u, middle).measure > wanted ? low : high) = middle;
    }
    return low;
  }
  double log_modulus(double height) const { return map->soft_end(u).log_modulus + height + log_viscosity; }
  CellLaw law() const { return {{u, log_modulus(std::max(x, 0.02)), spread, 0.2, 0}}; }

  ParameterBounds bounds(bool is_of_one_elongation) const {
    const auto radii = map->log_radii();
    const auto heights = map->heights();
    const double slope = is_of_one_elongation ? 0 : steepest;
    ParameterBounds bounds;
    bounds.least << radii.lower, log_modulus(heights.lower - 1), std::log(least_radius_spread),
        std::log(least_modulus_spread), -greatest_artanh, -slope, -slope;
    bounds.greatest << radii.upper, log_modulus(heights.upper), std::log(greatest_radius_spread),
        std::log(greatest_modulus_spread), greatest_artanh, slope, slope;
    return bounds;
  }

  const ForwardMap* map = nullptr;
  double u, x, log_viscosity, measure, noise, spread;
};

class CellFit {
 public:
  CellFit(const Sample& sample, const FitSettings& settings)
      : settings_(settings),
        start_(sample),
        bounds_(start_.bounds(sample.is_of_one_elongation())),
        events_(sample.events()),
        likelihood_(sample, settings.threads, settings.nodes) {}

  FittedCells fit() {
    FittedCells fitted;
    if (!climb(start_.law().parameters())) return fitted;
    fitted.law = CellLaw::of(best_.q);
    fitted.cells = CellDistribution::of(population(best_.q));
    fitted.log_likelihood = best_.log_likelihood;
    std::copy_n(best_.at_bound.begin(), population_parameters, fitted.at_bound.begin());
    fitted.kept_fraction = likelihood_.kept_fraction(fitted.law);
    fitted.event_error = error_of_image();
    fitted.state = state(fitted);
    if (settings_.with_shrunken && fitted.state == FitState::fitted) fitted.shrunken = likelihood_.shrunken(fitted.law);
    if (fitted.state == FitState::fitted) tell_intervals(fitted);
    if (fitted.state == FitState::too_stiff) fitted.least_log_modulus = least_log_modulus();
    return fitted;
  }

 private:
  /// To the maximum, with nodes that are placed for it.
  bool climb(LawVector q, const HeldParameters& held = {}) {
    for (int round = 0; round < most_placings; ++round) {
      likelihood_.place(CellLaw::of(q));
      const LikelihoodMaximum found = maximise(likelihood_, q, bounds_, held, information_);
      if (!found.is_found) return false;
      const double moved = moved_fraction(q, found.q);
      q = found.q;
      best_ = found;
      if (moved < settled_fraction) break;
    }
    return true;
  }

  /// In spreads of the cells.
  static double moved_fraction(const LawVector& from, const LawVector& to) {
    const CellDistribution cells = CellLaw::of(to).usual;
    const double su = cells.radius_spread, se = cells.modulus_spread;
    LawVector units;
    units << su, se, 1, 1, 1, su, se;
    return ((to - from).cwiseAbs().array() / units.array()).maxCoeff();
  }

  double error_of_image() const {
    const auto radii = start_.map->log_radii();
    const auto heights = start_.map->heights();
    const ParameterVector cells = population(best_.q);
    const double u = std::clamp(cells(0), radii.lower, radii.upper), end = start_.map->soft_end(u).log_modulus;
    const double x = std::clamp(cells(1) - start_.log_viscosity - end, heights.lower, heights.upper);
    return event_error(*start_.map, u, end + x);
  }

  FitState state(FittedCells& fitted) const {
    if (start_.measure < start_.noise) return FitState::too_stiff;
    if (fitted.kept_fraction < least_kept_fraction) return FitState::tail;
    const LawVector steps = difference_steps(best_.products);
    const auto covariance = inverse(likelihood_.information(best_.q, steps), best_.at_bound);
    if (!covariance) return FitState::singular;
    fitted.covariance = covariance_of_population(*covariance, steps);
    for (int k = 0; k < population_parameters; ++k)
      if (fitted.at_bound[std::size_t(k)]) fitted.covariance.row(k).setZero(), fitted.covariance.col(k).setZero();
    return FitState::fitted;
  }

  /// Of cells of all elongations together.
  ParameterVector population(const LawVector& q) const {
    const CellLaw law = CellLaw::of(q);
    const auto [mean, variance] = likelihood_.elongations(law);
    return law.population(mean, variance).parameters();
  }

  /// From that of the law's parameters, by differences; of the elongations of n events the mean is known to
  /// variance / n, the variance to 2 variance^2 / n.
  ParameterMatrix covariance_of_population(const LawMatrix& of_law, const LawVector& steps) const {
    Eigen::Matrix<double, population_parameters, law_parameters> slopes;
    for (int k = 0; k < law_parameters; ++k) {
      const LawVector step = steps(k) * LawVector::Unit(k);
      slopes.col(k) = (population(best_.q + step) - population(best_.q - step)) / (2 * steps(k));
    }
    const CellLaw law = CellLaw::of(best_.q);
    const auto [mean, variance] = likelihood_.elongations(law);
    const double off_mean = std::sqrt(variance / events_), off_variance = variance * std::sqrt(2 / events_);
    const ParameterVector usual = law.population(mean, variance).parameters(),
                          by_mean = law.population(mean + off_mean, variance).parameters() - usual,
                          by_variance = law.population(mean, variance + off_variance).parameters() - usual;
    return slopes * of_law * slopes.transpose() + by_mean * by_mean.transpose() + by_variance * by_variance.transpose();
  }

  /// Of the parameters that are at no bound; 0 of the others. Nothing if the information is singular.
  static std::optional<LawMatrix> inverse(const LawMatrix& information,
                                          const std::array<bool, law_parameters>& at_bound) {
    std::vector<int> free;
    for (int k = 0; k < law_parameters; ++k)
      if (!at_bound[std::size_t(k)]) free.push_back(k);
    const Eigen::Index n = Eigen::Index(free.size());
    if (n == 0) return {};
    Eigen::MatrixXd part(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) part(i, j) = information(free[std::size_t(i)], free[std::size_t(j)]);
    const Eigen::MatrixXd white = whitening(part);
    if (white.size() == 0 || !white.allFinite()) return {};
    const Eigen::MatrixXd covariance = white.transpose() * white;
    LawMatrix all = LawMatrix::Zero();
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) all(free[std::size_t(i)], free[std::size_t(j)]) = covariance(i, j);
    return all;
  }

  void tell_intervals(FittedCells& fitted) {
    const double z = normal_quantile((1 + settings_.level) / 2);
    const LikelihoodMaximum maximum = best_;
    for (int k = 0; k < population_parameters; ++k) {
      auto& interval = fitted.intervals[std::size_t(k)];
      interval = {no_value, no_value};
      if (fitted.at_bound[std::size_t(k)]) continue;
      const double error = std::sqrt(fitted.covariance(k, k)), middle = fitted.cells.parameters()(k);
      interval = normal_interval(middle, error, settings_.level);
      if (!wants_profile(k, fitted)) continue;
      interval = {profile_end(maximum, k, -error, z), profile_end(maximum, k, error, z), true};
    }
    best_ = maximum;
  }

  static bool wants_profile(int k, const FittedCells& fitted) {
    if (fitted.kept_fraction < parabolic_kept) return true;
    return k == number_of(PopulationParameter::log_modulus_spread) &&
           fitted.cells.modulus_spread < least_fraction_of_error * fitted.event_error;
  }

  /// Where ln L, at its greatest over the other parameters, is lower by z^2 / 2, the parameter of the population. NaN
  /// if there is no such place.
  double profile_end(const LikelihoodMaximum& maximum, int k, double error, double z) {
    HeldParameters held{};
    held[std::size_t(k)] = true;
    LawVector q = maximum.q;
    double offset = z * error;
    for (int step = 0; step < profile_steps; ++step) {
      q(k) = maximum.q(k) + offset;
      if (q(k) < bounds_.least(k) || q(k) > bounds_.greatest(k)) return no_value;
      if (!climb(q, held)) return no_value;
      q = best_.q;
      // The root of the likelihood ratio is nearly linear in the parameter.
      const double root = std::sqrt(2 * std::max(maximum.log_likelihood - best_.log_likelihood, 0.0));
      const double next = offset * std::clamp(z / root, 0.5, 2.0);
      const bool is_settled = std::abs(next - offset) < profile_tolerance * std::abs(error);
      if (is_settled) break;
      offset = next;
    }
    return population(best_.q)(k);
  }

  std::optional<double> least_log_modulus() {
    const double z = normal_quantile(settings_.level);
    const LikelihoodMaximum maximum = best_;
    const int k = number_of(PopulationParameter::mean_log_modulus);
    const double error = 10 * difference_steps(maximum.products)(k);
    const double end = profile_end(maximum, k, -std::min(error, 0.5), z);
    best_ = maximum;
    return std::isfinite(end) ? std::optional(end) : std::nullopt;
  }

  FitSettings settings_;
  Start start_;
  ParameterBounds bounds_;
  double events_;
  PopulationLikelihood likelihood_;
  LikelihoodMaximum best_;
  std::optional<LawMatrix> information_;  ///< near the maximum, once the search has come there
};

}  // namespace

double FittedCells::standard_error(PopulationParameter parameter) const {
  const int k = number_of(parameter);
  return at_bound[std::size_t(k)] ? no_value : std::sqrt(covariance(k, k));
}

ParameterInterval normal_interval(double value, double standard_error, double level) {
  const double half = normal_quantile((1 + level) / 2) * standard_error;
  return {value - half, value + half};
}

FittedCells fit_cells(const Sample& sample, const FitSettings& settings) {
  assert(sample.events() > 0);
  return CellFit(sample, settings).fit();
}

}  // namespace rheocyte
