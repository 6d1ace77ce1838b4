// A state's fields for a picture, from its high-order elements.
#pragma once
#include <vector>

#include "fem/nodal_fields.h"
#include "fem/sampled_fields.h"

namespace rheocyte {

/// A face of an element, or all of it, by the numbers of its nodes within it; first coordinate fastest.
struct FaceInPlane {
  int element;
  std::vector<int> nodes;
};

/// About so many points, spread evenly over faces in a plane along the flow; `across`: its other direction, by those
/// after x. Places are those of the mesh.
SampledFields sample_faces(const NodalFields&, const std::vector<FaceInPlane>&, const VectorXd& across, int points);

}  // namespace rheocyte
