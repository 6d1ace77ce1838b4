#include "solve/path.h"

#include <cmath>
#include <utility>

namespace rheocyte {

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
