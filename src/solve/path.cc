#include "solve/path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>

namespace rheocyte {
namespace {

/// The systems of a path; those of the last few radii are kept, as a tangent needs two and a step one.
class Systems {
 public:
  Systems(const Problem& from, const Problem& to, const Resolution& resolution)
      : from_(from), to_(to), resolution_(path_resolution(from, to, resolution)) {}

  StationarySystem& at(double s) {
    const double key = from_.radius_ratio == to_.radius_ratio ? 0 : s;
    auto found = systems_.find(key);
    if (found == systems_.end()) {
      if (order_.size() == kept) {
        systems_.erase(order_.front());
        order_.erase(order_.begin());
      }
      order_.push_back(key);
      found = systems_.emplace(key, std::make_unique<Discrete>(between(from_, to_, s), resolution_)).first;
    }
    return found->second->system;
  }

 private:
  static constexpr std::size_t kept = 4;
  Problem from_, to_;
  Resolution resolution_;
  std::map<double, std::unique_ptr<Discrete>> systems_;
  std::vector<double> order_;
};

double mean(double a, double b, double s) {
  return a > 0 && b > 0 ? std::exp((1 - s) * std::log(a) + s * std::log(b)) : (1 - s) * a + s * b;
}

}  // namespace

Discrete::Discrete(const Problem& problem, const Resolution& resolution)
    : mesh(ChannelGeometry(problem.radius_ratio, problem.channel_length), resolution.subdivision),
      space(mesh, resolution.degree, media_at(problem, 1).liquid, interior_of(problem), problem.drive),
      system(space) {}

Media media_at(const Problem& problem, double compliance) {
  Media media;
  media.liquid = {problem.liquid, problem.exponent, problem.shear_rate_floor, problem.reynolds};
  media.bulk = {problem.shear_modulus / compliance, problem.mooney_share};
  media.cortex = {problem.cortex, problem.cortex_modulus / compliance, problem.tension / compliance,
                  problem.bending_stiffness / compliance};
  return media;
}

double Path::unit(double parameter) const { return std::isfinite(origin) ? parameter - origin : 1; }

Path stiffness_path(StationarySystem& system, const Problem& problem) {
  return {[&system](double) -> StationarySystem& { return system; },
          [problem](double compliance) { return media_at(problem, compliance); }};
}

Problem between(const Problem& from, const Problem& to, double s) {
  assert(interior_of(from) == interior_of(to) && from.liquid == to.liquid);
  assert(from.cortex == to.cortex || from.cortex_modulus == 0 || to.cortex_modulus == 0);
  if (s == 0) return from;
  Problem problem = to;
  if (s == 1) return problem;
  for (double Problem::*number :
       {&Problem::radius_ratio, &Problem::exponent, &Problem::shear_rate_floor, &Problem::reynolds,
        &Problem::shear_modulus, &Problem::cortex_modulus, &Problem::tension, &Problem::bending_stiffness})
    problem.*number = mean(from.*number, to.*number, s);
  problem.mooney_share = (1 - s) * from.mooney_share + s * to.mooney_share;
  if (from.cortex_modulus > 0) problem.cortex = from.cortex;
  return problem;
}

Resolution path_resolution(const Problem& from, const Problem& to, Resolution resolution) {
  int layers = resolution.subdivision.layers;
  for (const Problem& end : {from, to})
    layers = std::max(layers, layers_for(ChannelGeometry(end.radius_ratio), resolution.subdivision));
  resolution.subdivision.layers = layers;
  return resolution;
}

Path problem_path(const Problem& from, const Problem& to, const Resolution& resolution) {
  const auto systems = std::make_shared<Systems>(from, to, resolution);
  return {[systems](double s) -> StationarySystem& { return systems->at(s); },
          [from, to](double s) { return media_at(between(from, to, s), 1); }, 1,
          -std::numeric_limits<double>::infinity()};
}

}  // namespace rheocyte
