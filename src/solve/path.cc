#include "solve/path.h"

#include <cmath>
#include <utility>

namespace rheocyte {
Discrete::Discrete(const Problem& problem, const Resolution& resolution)
    : mesh(geometry_of(problem), resolution.subdivision),
      space(mesh, resolution.degree, problem.liquid, interior_of(problem), problem.drive),
      system(space) {}

void Discrete::move_to(const Problem& problem, const Resolution& resolution) {
  mesh = ChannelMesh(geometry_of(problem), resolution.subdivision);
  space = Discretisation(mesh, resolution.degree, problem.liquid, interior_of(problem), problem.drive);
  system.follow_space();
}

double Path::unit(double parameter) const { return std::isfinite(origin) ? parameter - origin : 1; }

MediaAt softening(const Media& media) {
  return [media](double compliance) { return media_at(media, compliance); };
}

Path stiffness_path(NonlinearSystem& system, MediaAt media) {
  return {[&system](double) -> NonlinearSystem& { return system; }, std::move(media)};
}

Path stiffness_path(NonlinearSystem& system, const Problem& problem) {
  return stiffness_path(system, softening(problem));
}

}  // namespace rheocyte
