// The fields of a state in a duct, in the part that symmetry leaves.
#pragma once
#include "duct/duct_integrals.h"
#include "fem/nodal_fields.h"
#include "fem/sampled_fields.h"

namespace rheocyte {

class DuctFields final : public NodalFields {
 public:
  DuctFields(const DuctSpace& space, const Media& media, const VectorXd& unknowns, const Scales& scales)
      : NodalFields(space, media, unknowns, scales),
        space_(space),
        unknowns_(unknowns),
        um_(scales.length_um()),
        element_(space.reference()) {}

  /// About so many points of the mirror plane that the camera looks at, or of the nearest to it, and the cell's whole
  /// surface. Places are those of the mesh.
  SampledFields sample(Camera, int points) const;

 private:
  ElementState state_of(int e) const override;
  void add_surface(SampledFields&) const;

  const DuctSpace& space_;
  const VectorXd& unknowns_;
  double um_;
  TensorElement element_;
};

}  // namespace rheocyte
