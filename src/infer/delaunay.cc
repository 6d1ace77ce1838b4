#include "infer/delaunay.h"

#include <libqhull_r/qhull_ra.h>

#include <cstdio>
#include <memory>

#include "infer/triangulation.h"
#include "store/system_files.h"

namespace rheocyte {

namespace {

// What scipy 1.x passes for points in the plane: Delaunay, scaled last coordinate, coplanar points kept, a point at
// infinity, wide facets allowed, triangulated output.
constexpr const char* options = "qhull d Qt Qbb Qc Qz Q12";

// Qhull prints its errors; they are of no use to the user, whose sentence says what is wrong with the points.
struct Silence {
  std::FILE* file = std::fopen(nowhere, "w");
  ~Silence() {
    if (file) std::fclose(file);
  }
};

}  // namespace

std::vector<std::array<std::int32_t, 3>> delaunay_triangles(std::span<const PlanePoint> points) {
  std::vector<coordT> coordinates;
  for (const auto& point : points) coordinates.insert(coordinates.end(), {point.x, point.y});
  const Silence silence;
  const auto state = std::make_unique<qhT>();
  qhT* const qh = state.get();
  qh_zero(qh, silence.file);
  std::string flags = options;
  const int failed = qh_new_qhull(qh, 2, static_cast<int>(points.size()), coordinates.data(), False, flags.data(),
                                  nullptr, silence.file);
  std::vector<std::array<std::int32_t, 3>> triangles;
  if (!failed) {
    facetT* facet = nullptr;
    FORALLfacets {
      if (facet->upperdelaunay) continue;
      std::array<std::int32_t, 3> corners{};
      std::size_t k = 0;
      vertexT *vertex = nullptr, **vertexp = nullptr;
      // Qhull's sets go on behind their last field.
      FOREACHvertex_(facet->vertices) {  // NOLINT(clang-analyzer-security.ArrayBound)
        if (k < 3) corners[k] = qh_pointid(qh, vertex->point);
        ++k;
      }
      if (k == 3) triangles.push_back(corners);
    }
  }
  qh_freeqhull(qh, !qh_ALL);
  int still_used = 0, total = 0;
  qh_memfreeshort(qh, &still_used, &total);
  return triangles;
}

}  // namespace rheocyte
