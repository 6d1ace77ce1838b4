// The system of the stationary problem (docs/theory.md, eq:weak).
#pragma once
#include "fem/coupled_system.h"

namespace rheocyte {

class StationarySystem final : public CoupledSystem {
 public:
  /// The discretisation must outlive this object.
  explicit StationarySystem(const Discretisation& space) : CoupledSystem(space, space.elements()) {}
  /// Goes on with one that differs in its geometry alone.
  void follow_space(const Discretisation& space) { CoupledSystem::follow_space(space, space.elements()); }

 private:
  void integrate(int element, const Media& media, const VectorXd& unknowns, Want want,
                 ElementSystem& system) const override {
    integrate_element(space(), element, media, unknowns, want, system);
  }
};

}  // namespace rheocyte
