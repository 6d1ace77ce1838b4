#include "population/fit_moments.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "numeric/dense_solve.h"
#include "population/strangers.h"

namespace rheocyte {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_steps_of_turn = 40, most_moment_newton_steps = 10;
/// In standard errors: nearer to the end Newton's method is tried.
constexpr double most_distance_of_newton = 20;
/// Steps below this fraction of a standard error change nothing that is reported.
constexpr double moment_tolerance = 0.03;
constexpr double first_damping = 1e-3, greatest_damping = 1e8;

/// What the search for some of the parameters sees: slopes of the logarithm of the likelihood of one event, and its
/// information.
struct Direction {
  VectorXd score;
  MatrixXd information;
};

class MomentSearch {
 public:
  MomentSearch(const MomentModel& model, const MatrixXd& events, const VectorXd& start, const MomentSettings& settings)
      : model_(model), events_(events), settings_(settings) {
    assert(events.allFinite());
    found_.is_stranger = strangers(events);
    found_.events = std::size_t(std::ranges::count(found_.is_stranger, false));
    found_.measured = moments_of(events, found_.is_stranger);
    found_.parameters = start.cwiseMax(settings.least).cwiseMin(settings.greatest);
    found_.at_bound.assign(std::size_t(start.size()), false);
    weight_ = dense_inverse(found_.measured.covariance + double(found_.events) * settings.common_covariance);
  }

  /// Both parts in turn, until Newton's method for all equations together takes over. Moments have kinks where the
  /// model's pieces meet: what neither moves any more is the end, too.
  MomentFit search() {
    if (!weight_.allFinite()) return found_;
    for (int turn = 0; turn < settings_.most_turns && !found_.is_found; ++turn) {
      const VectorXd before = found_.parameters;
      if (!minimise(Part::means) || !minimise(Part::scatter)) return found_;
      Equations e = equations();
      for (int k = 0; k < most_moment_newton_steps; ++k) {
        const double moved = distance(e);
        if (moved < moment_tolerance || !(moved < most_distance_of_newton) || !newton_step(e, moved)) break;
        e = equations();
      }
      tell(e);
      found_.is_found = distance(e) < moment_tolerance || is_at_rest(before);
    }
    if (found_.is_found) tell(equations(Held::with_means));
    return found_;
  }

 private:
  enum class Part { means, scatter };
  enum class Held { without, with_means };

  /// A step that leads on is where the next one begins: slopes with it cost less than the model once more.
  const MomentSlopes& slopes_at(const VectorXd& parameters) {
    if (slopes_.by_parameter.empty() || parameters != place_of_slopes_) {
      slopes_ = model_.slopes(parameters);
      place_of_slopes_ = parameters;
    }
    return slopes_;
  }

  std::vector<int> parameters_of(Part part) const {
    const int first = part == Part::means ? 0 : model_.means(),
              last = part == Part::means ? model_.means() : int(found_.parameters.size());
    std::vector<int> all(std::size_t(last - first));
    std::iota(all.begin(), all.end(), first);
    return all;
  }

  /// Of the means: chi squared in one event's scatter. Of the scatter: minus twice the logarithm of the likelihood of a
  /// normal distribution about the measured mean.
  double loss_of(Part part, const Moments& moments) const {
    if (!moments.mean.allFinite()) return HUGE_VAL;
    const VectorXd off = found_.measured.mean - moments.mean;
    if (part == Part::means) return off.dot(weight_ * off);
    const MatrixXd white = whitening(moments.covariance);
    if (white.size() == 0) return HUGE_VAL;
    return (white * found_.measured.covariance * white.transpose()).trace() - 2 * white.diagonal().array().log().sum();
  }

  Direction direction(Part part, const MomentSlopes& s, const std::vector<int>& parameters) const {
    const auto n = Eigen::Index(parameters.size());
    Direction found{VectorXd(n), MatrixXd(n, n)};
    const VectorXd off = weight_ * (found_.measured.mean - s.there.mean);
    const MatrixXd precision = part == Part::means ? weight_ : dense_inverse(s.there.covariance);
    const MatrixXd scatter = precision * (found_.measured.covariance - s.there.covariance) * precision;
    for (Eigen::Index a = 0; a < n; ++a) {
      const Moments& by = s.by_parameter[std::size_t(parameters[std::size_t(a)])];
      const MatrixXd weighed = precision * by.covariance * precision;
      found.score(a) = part == Part::means ? by.mean.dot(off) : scatter.cwiseProduct(by.covariance).sum() / 2;
      for (Eigen::Index b = 0; b < n; ++b) {
        const Moments& other = s.by_parameter[std::size_t(parameters[std::size_t(b)])];
        found.information(a, b) =
            part == Part::means ? by.mean.dot(weight_ * other.mean) : weighed.cwiseProduct(other.covariance).sum() / 2;
      }
    }
    return found;
  }

  /// By Fisher's scoring, damped as far as it does not lead on, of those that are not held at a bound. False without a
  /// minimum.
  bool minimise(Part part) {
    double damping = first_damping, loss = loss_of(part, slopes_at(found_.parameters).there);
    for (int k = 0; k < most_steps_of_turn && std::isfinite(loss); ++k) {
      settings_.watch.go_on();
      const MomentSlopes& slopes = slopes_at(found_.parameters);
      const std::vector<int> free = free_of(part, slopes);
      if (free.empty()) return true;
      const Direction d = direction(part, slopes, free);
      const VectorXd error = (dense_inverse(d.information).diagonal() / double(found_.events)).cwiseSqrt();
      const VectorXd step = solve_dense(d.information, d.score);
      if (!((step.array() / error.array()).abs().maxCoeff() > moment_tolerance / 2)) return step.allFinite();
      while (!try_step(part, free, d, damping, loss)) {
        damping *= 4;
        if (damping > greatest_damping) return true;  // as near as rounding lets it come
      }
      damping = std::max(damping / 8, 1e-9);
    }
    return std::isfinite(loss);
  }

  std::vector<int> free_of(Part part, const MomentSlopes& slopes) {
    const std::vector<int> all = parameters_of(part);
    const Direction d = direction(part, slopes, all);
    std::vector<int> free;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const int a = all[k];
      const double uphill = d.score(Eigen::Index(k));
      const bool is_held = (found_.parameters(a) <= settings_.least(a) && uphill <= 0) ||
                           (found_.parameters(a) >= settings_.greatest(a) && uphill >= 0);
      found_.at_bound[std::size_t(a)] = is_held;
      if (!is_held) free.push_back(a);
    }
    return free;
  }

  bool try_step(Part part, const std::vector<int>& free, const Direction& d, double damping, double& loss) {
    MatrixXd damped = d.information;
    damped.diagonal() *= 1 + damping;
    const VectorXd step = solve_dense(damped, d.score);
    VectorXd next = found_.parameters;
    next(free) += step;
    next = next.cwiseMax(settings_.least).cwiseMin(settings_.greatest);
    const double there = loss_of(part, slopes_at(next).there);
    if (!(there < loss)) return false;
    found_.parameters = next;
    loss = there;
    return true;
  }

  /// Those of both parts for the parameters that are not held: each is 0 at the end.
  struct Equations {
    std::vector<int> free, means, scatter;
    MomentSlopes slopes;
    VectorXd value;
    MatrixXd matrix;  ///< minus its slopes by the parameters
  };

  /// Means that are fixed at a bound have errors like the others: the bound is the model's, not the cells'. Equal
  /// bounds are what is known of them.
  Equations equations(Held held = Held::without) {
    settings_.watch.go_on();
    Equations e;
    e.slopes = slopes_at(found_.parameters);
    e.means = free_of(Part::means, e.slopes);
    if (held == Held::with_means) {
      e.means = parameters_of(Part::means);
      std::erase_if(e.means, [&](int a) { return settings_.least(a) == settings_.greatest(a); });
    }
    e.scatter = free_of(Part::scatter, e.slopes);
    e.free = e.means;
    e.free.insert(e.free.end(), e.scatter.begin(), e.scatter.end());
    const auto n = Eigen::Index(e.free.size()), m = Eigen::Index(e.means.size());
    e.value.resize(n);
    e.value << direction(Part::means, e.slopes, e.means).score, direction(Part::scatter, e.slopes, e.scatter).score;
    e.matrix.resize(n, n);
    e.matrix.topRows(m) = direction(Part::means, e.slopes, e.free).information.topRows(m);
    e.matrix.bottomRows(n - m) = direction(Part::scatter, e.slopes, e.free).information.bottomRows(n - m);
    if (held == Held::with_means) add_prior(e);
    return e;
  }

  /// Of what is held: somewhere within its bounds.
  void add_prior(Equations& e) const {
    for (std::size_t k = 0; k < e.means.size(); ++k) {
      const int a = e.means[k];
      const double range = settings_.greatest(a) - settings_.least(a);
      if (found_.at_bound[std::size_t(a)] && std::isfinite(range))
        e.matrix(Eigen::Index(k), Eigen::Index(k)) += 1 / (double(found_.events) * range * range);
    }
  }

  /// Of the end, in standard errors of the parameters as far as one event's information determines them.
  double distance(const Equations& e) const {
    const VectorXd step = solve_dense(e.matrix, e.value);
    const VectorXd error = (dense_inverse(e.matrix).diagonal().cwiseAbs() / double(found_.events)).cwiseSqrt();
    return (step.array() / error.array()).abs().maxCoeff();
  }

  bool is_at_rest(const VectorXd& before) const {
    const VectorXd moved = (found_.parameters - before).cwiseAbs(), error = found_.covariance.diagonal().cwiseSqrt();
    return found_.covariance.allFinite() && (moved.array() <= moment_tolerance * error.array()).all();
  }

  bool newton_step(const Equations& e, double moved) {
    const VectorXd before = found_.parameters;
    found_.parameters(e.free) += solve_dense(e.matrix, e.value);
    found_.parameters = found_.parameters.cwiseMax(settings_.least).cwiseMin(settings_.greatest);
    const bool leads_on = slopes_at(found_.parameters).there.mean.allFinite() && distance(equations()) < moved / 2;
    if (!leads_on) found_.parameters = before;
    return leads_on;
  }

  /// The scores of single events: those of the means are linear in what was measured, those of the scatter quadratic.
  MatrixXd products_of_scores(const Equations& e, const MatrixXd& linear) const {
    const auto m = Eigen::Index(e.means.size()), n = Eigen::Index(e.free.size());
    const MatrixXd precision = dense_inverse(e.slopes.there.covariance);
    std::vector<MatrixXd> quadratic;
    for (Eigen::Index a = m; a < n; ++a) quadratic.emplace_back(precision * slope(e, a).covariance * precision / 2);
    MatrixXd products = MatrixXd::Zero(n, n);
    VectorXd score(n);
    for (Eigen::Index i = 0; i < events_.rows(); ++i) {
      if (found_.is_stranger[std::size_t(i)]) continue;
      const VectorXd measured = events_.row(i).transpose(), off = measured - found_.measured.mean;
      score.head(m) = linear * off;
      for (Eigen::Index a = m; a < n; ++a) {
        const MatrixXd& q = quadratic[std::size_t(a - m)];
        score(a) = off.dot(q * off) - q.cwiseProduct(e.slopes.there.covariance).sum();
      }
      products += score * score.transpose();
    }
    return products;
  }

  static const Moments& slope(const Equations& e, Eigen::Index place) {
    return e.slopes.by_parameter[std::size_t(e.free[std::size_t(place)])];
  }

  /// With the slopes of the equations on both sides of the scatter of the events' scores (Huber 1967).
  void tell(const Equations& e) {
    const auto m = Eigen::Index(e.means.size()), n = Eigen::Index(e.free.size());
    MatrixXd by_shift = MatrixXd::Zero(n, found_.measured.mean.size());
    for (Eigen::Index a = 0; a < m; ++a) by_shift.row(a) = slope(e, a).mean.transpose() * weight_;
    const MatrixXd bread = dense_inverse(e.matrix);
    const auto all = found_.parameters.size();
    found_.covariance = MatrixXd::Zero(all, all);
    found_.covariance(e.free, e.free) =
        bread * products_of_scores(e, by_shift.topRows(m)) * bread.transpose() / std::pow(double(found_.events), 2);
    found_.by_shift = MatrixXd::Zero(all, by_shift.cols());
    found_.by_shift(e.free, Eigen::all) = bread * by_shift;
    found_.fitted = e.slopes.there;
    found_.misfit = loss_of(Part::means, e.slopes.there) * double(found_.events);
  }

  const MomentModel& model_;
  const MatrixXd& events_;
  const MomentSettings& settings_;
  MatrixXd weight_;  ///< inverse of the covariance of the events
  VectorXd place_of_slopes_;
  MomentSlopes slopes_;
  MomentFit found_;
};

}  // namespace

MomentFit fit_moments(const MomentModel& model, const MatrixXd& events, const VectorXd& start,
                      const MomentSettings& settings) {
  return MomentSearch(model, events, start, settings).search();
}

}  // namespace rheocyte
