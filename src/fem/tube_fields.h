// The fields of a state in a tube, in the half-plane of its meridian.
#pragma once
#include "fem/discretisation.h"
#include "fem/nodal_fields.h"
#include "fem/sampled_fields.h"

namespace rheocyte {

class TubeFields final : public NodalFields {
 public:
  TubeFields(const Discretisation& space, const Media& media, const VectorXd& unknowns, const Scales& scales)
      : NodalFields(space, media, unknowns, scales), space_(space), unknowns_(unknowns) {}

 private:
  ElementState state_of(int e) const override;

  const Discretisation& space_;
  const VectorXd& unknowns_;
};

/// About so many points, spread evenly over the elements. Places are those of the mesh.
SampledFields sample_fields(const TubeFields&, int points);

}  // namespace rheocyte
