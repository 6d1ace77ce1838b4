#include "sweep/branch_meshes.h"

namespace rheocyte {
namespace {

struct Level {
  Resolution resolution;
  double fraction_of_change;
};
using Levels = std::array<Level, BranchMeshes::levels>;

const Levels smooth = {{{{{2, 4, 1, 2}, 5}, 1},
                        {{{2, 4, 1, 2}, 6}, 1},
                        {{{2, 4, 1, 2}, 8}, 0.5},
                        {{{3, 6, 1, 2}, 8}, 0.5},
                        {{{3, 6, 1, 2}, 10}, 0.5},
                        {{{4, 8, 2, 2}, 10}, 0.5}}};
/// The rim of a dented cell is sharp, and needs elements rather than degrees.
const Levels bent = {{{{{2, 4, 1, 2}, 5}, 1},
                      {{{2, 4, 1, 2}, 6}, 1},
                      {{{2, 4, 1, 2}, 8}, 0.5},
                      {{{2, 10, 1, 2}, 6}, 1},
                      {{{2, 10, 1, 2}, 7}, 1},
                      {{{2, 10, 1, 2}, 8}, 0.5}}};

const Level& level_of(const Problem& problem, int level) {
  return (problem.cortex.bending > 0 ? bent : smooth)[std::size_t(level)];
}

double factorisation_seconds_of(TubeDiscrete& discrete) { return discrete.system().work().factorisation_s; }

}  // namespace

double fraction_of_change(const Problem& problem, int level) { return level_of(problem, level).fraction_of_change; }

TubeDiscrete& BranchMeshes::at(int level) {
  auto& discrete = discrete_[std::size_t(level)];
  if (!discrete) {
    discrete = std::make_shared<TubeDiscrete>(problem_, level_of(problem_, level).resolution);
    if (const auto like_it = fitted_ ? discrete->fitted_as(*fitted_) : nullptr)
      discrete = std::static_pointer_cast<TubeDiscrete>(like_it);
  }
  return *discrete;
}

void BranchMeshes::release_coarser_than(int level) {
  for (int i = 0; i < level - 1; ++i) {
    auto& discrete = discrete_[std::size_t(i)];
    if (discrete) released_factorisation_ += factorisation_seconds_of(*discrete);
    discrete.reset();
  }
}

void BranchMeshes::drop_factors() {
  for (const auto& discrete : discrete_)
    if (discrete) discrete->system().drop_factors();
}

double BranchMeshes::factorisation_seconds() const {
  double seconds = released_factorisation_;
  for (const auto& discrete : discrete_)
    if (discrete) seconds += factorisation_seconds_of(*discrete);
  return seconds;
}

}  // namespace rheocyte
