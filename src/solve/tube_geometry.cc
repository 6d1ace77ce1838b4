// Where the states of a tube are looked for: resolutions of the way and of the rungs.
#include <algorithm>
#include <memory>

#include "solve/tube.h"

namespace rheocyte {
namespace {

constexpr Subdivision coarse{2, 4, 1, 2}, dense{2, 10, 1, 2}, densest{4, 10, 2, 2}, middle{3, 6, 1, 2},
    fine{4, 8, 2, 2};

/// Of Newton's method: what rounding leaves of the residual where a sharp rim is bent is up to 1e-9.
constexpr double of_bent_surface = 1e-8;

/// So much farther may a branch go on finer meshes that its coarse ends say nothing.
constexpr double never_hopeless = 100;

/// Above this r0 / R the liquid's film is so thin and long that the coarsest mesh is only compared with.
constexpr double narrow_gap = 0.85;

std::shared_ptr<Discrete> tube_discrete(const Problem& problem, const Resolution& resolution) {
  return std::make_shared<TubeDiscrete>(problem, resolution);
}

/// The layers of liquid depend on the radius, and so does whether the channel is longer than it need be, which takes an
/// element more.
bool have_same_elements(const Problem& a, const Problem& b, const Resolution& resolution) {
  const auto elements = [&](const Problem& problem) {
    return ChannelMesh(geometry_of(problem), resolution.subdivision, spacing_for(problem.liquid)).elements();
  };
  return spacing_for(a.liquid) == spacing_for(b.liquid) &&
         std::ranges::equal(elements(a), elements(b), {}, &MeshElement::block, &MeshElement::block);
}

/// The rim of a dented cell is sharp, wanders along the surface as the cell softens, and is seen by no coarse mesh.
/// With one ring of elements between core and surface the bulk below it is not resolved.
void look_for_rims(Geometry& tube) {
  tube.ways = {{{coarse, 4}, false, Fits::once}, {{coarse, 6}, false, Fits::once}, {{dense, 6}}, {{dense, 8}}};
  tube.traces_ends = true;
  tube.along.iteration_limit = 8;
  tube.min_step_before_refining = 3e-3;
  tube.gain_of_finer = never_hopeless;
  const bool goes_on = tube.rungs.front().goes_on;
  tube.rungs.front().is_rough_at_rims = true;
  tube.rungs = {tube.rungs.front(), {dense, 6, 9, false, true, goes_on}, {densest, 6, 9, false, false, goes_on}};
  tube.fine.tolerance = of_bent_surface;
}

}  // namespace

/// Coarse resolutions cost 3 ms per Newton iteration and mostly go all the way; near the end of the branch the rear
/// shoulder and the front tip need the fine ones, which went on by a fifth and by a few times the change between two of
/// the coarse ones. Intermediate states serve as starting points only.
Geometry tube_geometry(const Problem& problem) {
  const NewtonOptions on_the_way{.tolerance = 1e-7};
  Geometry tube{.make = tube_discrete, .is_alike = have_same_elements};
  tube.ways = {{{coarse, 4}}, {{coarse, 6}}, {{middle, 6}}, {{middle, 8}}};
  tube.along = tube.across = on_the_way;
  tube.along.iteration_limit = 5;
  tube.min_step_before_refining = 0.03;
  tube.min_step_at_last = 2e-3;
  tube.gain_of_finer = 1.2;
  tube.gain_by_change = 6;
  tube.margin_at_coarse_ends = 0.3;
  tube.ends_late_on_finer = true;
  tube.knows_ends = true;
  const bool is_narrow = problem.radius_ratio > narrow_gap;
  tube.rungs = {{coarse, 4, is_narrow ? 5 : 9, is_narrow, false, is_narrow},
                {middle, 7, 10, false, false, is_narrow},
                {fine, 7, 10, false, false, is_narrow}};
  tube.fine.tolerance = 1e-10;
  tube.climbs_anew = true;
  tube.judges_rungs = true;
  tube.errors.fraction_of_inertia = 0.3;
  if (problem.cortex.bending > 0) look_for_rims(tube);
  return tube;
}

}  // namespace rheocyte
