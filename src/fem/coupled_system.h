// The nonlinear system of cell and liquid with axial symmetry. What an element contributes, the derived systems say.
#pragma once
#include <optional>
#include <utility>

#include "fem/assembled_system.h"
#include "fem/element_places.h"
#include "fem/surface_integrals.h"

namespace rheocyte {

class CoupledSystem : public AssembledSystem<double> {
 public:
  ~CoupledSystem() override;

  const Discretisation& space() const { return *space_; }

  double cell_radius() const override;
  double largest_displacement(const VectorXd& unknowns) const override;
  void scale_displacement(double factor, VectorXd& unknowns) const override;
  /// Of the meridional stretch.
  double stretch_change(const VectorXd& from, const VectorXd& to) const override;
  std::size_t memory_bytes() const override;

 protected:
  /// Pressure at an open inlet that depends on the acceleration of the frame: fixed + slope * v_cell.
  struct InletPressure {
    double fixed = 0, slope = 0;
  };

  /// The discretisation must outlive this object. Which unknowns a column refers to stays as it is given here; factors
  /// and constants of the columns may change.
  CoupledSystem(const Discretisation&, std::vector<ElementUnknowns>);
  /// Becomes that of another discretisation in which the same unknowns couple. The factors stay those of the old one.
  void follow_space(const Discretisation&, std::vector<ElementUnknowns>);
  /// Residual and, if requested, tangent of one element that is not empty.
  virtual void integrate(int element, const Media&, const VectorXd& unknowns, Want, ElementSystem&) const = 0;
  /// Only for an open inlet.
  virtual InletPressure inlet_pressure(const Media&) const;

  std::vector<ElementUnknowns>& elements() { return elements_; }
  const std::vector<ElementUnknowns>& elements() const { return elements_; }

 private:
  /// An element that is not empty, and what is integrated with it.
  struct Part {
    int element = 0;
    std::vector<int> patches = {};  ///< of the surface
    std::vector<int> inlet = {};    ///< equations with the load of an open inlet
  };
  std::vector<CoupledUnknowns> coupled_unknowns();
  void share_out_surface();
  void share_out_inlet(const VectorXd& load);
  VectorXd loads(const Media&, const VectorXd& unknowns) override;
  double add_part(int part, const At&, PartResidual&, PartWorkspace<double>&) const override;
  void add_element(int part, const At&, PartResidual&, PartWorkspace<double>&) const;
  /// Cortex, volume of a pure shell, and barycentre.
  void add_surface(const Part&, const At&, PartResidual&, PartWorkspace<double>&) const;
  /// At the inlet.
  double undisturbed_pressure(const Liquid&) const;

  const Discretisation* space_;
  std::vector<ElementUnknowns> elements_;
  SurfaceIntegrals surface_;
  std::vector<Part> parts_;
  std::vector<ElementPlaces> places_;  ///< of each part's element in its matrix
  /// Pressure gradient of the last liquid that was asked for: most have to integrate for it. It depends on nothing but
  /// the liquid; the pressure at the inlet depends on the space, too.
  mutable std::optional<std::pair<Liquid, double>> undisturbed_gradient_;
  VectorXd inlet_load_;  ///< of this moment
  double inlet_slope_ = 0;
};

/// Of a system with axial symmetry.
inline const Discretisation& space_of(const NonlinearSystem& system) {
  return static_cast<const CoupledSystem&>(system).space();
}

}  // namespace rheocyte
