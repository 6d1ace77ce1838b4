#include "duct/duct_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "duct/duct_ends.h"
#include "duct/observe_duct.h"

namespace rheocyte {
namespace {

std::vector<int> filled_elements(const DuctSpace& space) {
  std::vector<int> filled;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    if (!space.elements()[e].is_empty) filled.push_back(e);
  }
  return filled;
}

std::vector<CoupledUnknowns> coupled_unknowns(const DuctSpace& space, const DuctCortex& cortex,
                                              const std::vector<int>& filled) {
  const auto& elements = space.elements();
  std::vector<CoupledUnknowns> coupled(filled.size());
  std::vector<std::vector<int>> nodes;
  for (std::size_t part = 0; part < filled.size(); ++part) {
    const int e = filled[part];
    nodes.push_back(space.nodes().of_element[e]);
    std::vector<int>& unknowns = coupled[part].unknowns;
    unknowns = elements[e].rows;
    for (const auto* slots : {&elements[e].displacement, &elements[e].velocity}) {
      for (const Slot& slot : *slots) unknowns.push_back(slot.unknown);
    }
    const DuctElement& element = space.mesh().elements()[e];
    if (space.turns() && (touches_cell(element) || element.in_cell())) unknowns.push_back(space.spin());
    for (const int patch : cortex.patches_of(e)) {
      for (const Eigen::MatrixXi* of_patch : {&cortex.unknowns_of(patch), &cortex.equations_of(patch)})
        unknowns.insert(unknowns.end(), of_patch->data(), of_patch->data() + of_patch->size());
    }
    std::ranges::sort(unknowns);
    const auto [repeated, end] = std::ranges::unique(unknowns);
    unknowns.erase(repeated, end);
    std::erase(unknowns, -1);
    coupled[part].pressure = elements[e].pressure[0].unknown;
    coupled[part].medium = elements[e].liquid;
  }
  const auto nodes_1d = std::size_t(space.reference().degree()) + 1;
  set_neighbours(std::move(nodes), nodes_1d * nodes_1d, coupled);
  return coupled;
}

}  // namespace

DuctSystem::DuctSystem(const DuctSpace& space, double drop, bool bends)
    : AssembledSystem(space.unknowns(), space.cell_velocity()),
      space_(space),
      drop_(drop),
      element_(space.reference()),
      tangent_(element_, space.reference()),
      cortex_(space, bends),
      filled_(filled_elements(space)),
      turning_(space) {
  renew_end_loads();
  couple(coupled_unknowns(space, cortex_, filled_));
}

void DuctSystem::renew_end_loads() {
  outlet_load_ = duct_end_load(space_, Face::front);
  inlet_load_ = duct_end_load(space_, Face::rear);
}

double DuctSystem::undisturbed_gradient(const Liquid& liquid) const {
  if (!(undisturbed_ && undisturbed_->first == liquid))
    undisturbed_ = {liquid, space_.has_given_flow() ? 0 : space_.section().flow(liquid).pressure_gradient};
  return undisturbed_->second;
}

double DuctSystem::inlet_pressure(const Liquid& liquid) const {
  return drop_ * undisturbed_gradient(liquid) * space_.mesh().geometry().end();
}

VectorXd DuctSystem::loads(const Media& media, const VectorXd&) {
  const double at_inlet = inlet_pressure(media.liquid);
  VectorXd total = -at_inlet * outlet_load_;
  if (space_.has_open_inlet()) total -= at_inlet * inlet_load_;
  return total;
}

double DuctSystem::add_part(int part, const At& at, PartResidual& sum, PartWorkspace<float>& workspace) const {
  const int e = filled_[part];
  const HexahedronUnknowns& self = unknowns_of(e);
  Hexahedron hexahedron{space_, element_, e, self};
  if (self.spin >= 0) hexahedron.spin = at.unknowns(self.spin);
  const VectorXd residual = integrate_hexahedron(hexahedron, at.media, at.unknowns, at.want, workspace.element);
  for (int i = 0; i < residual.size(); ++i) sum.add(self.rows[i], residual(i));
  if (at.want == Want::residual_and_tangent) {
    tangent_.add(self, at.media.liquid.reynolds != 0, workspace);
    turning_.add_tangent(e, at.unknowns, workspace.place, workspace.matrix);
    if (self.spin >= 0) add_spin(hexahedron, at, residual, workspace);
  }
  add_cortex(e, at, sum, workspace);
  return workspace.element.min_det;
}

// The viscous stress is linear in the spin.
void DuctSystem::add_spin(Hexahedron at_spin, const At& at, const VectorXd& residual,
                          PartWorkspace<float>& workspace) const {
  at_spin.spin += 1;
  const VectorXd change =
      integrate_hexahedron(at_spin, at.media, at.unknowns, Want::residual, workspace.element) - residual;
  for (int i = 0; i < change.size(); ++i) {
    if (const int row = at_spin.self.rows[i]; row >= 0)
      workspace.matrix(workspace.place[row], workspace.place[at_spin.self.spin]) += float(change(i));
  }
}

void DuctSystem::add_cortex(int element, const At& at, PartResidual& sum, PartWorkspace<float>& workspace) const {
  const Cortex& cortex = at.media.cortex;
  const bool is_bare = cortex.law == CortexLaw::none && cortex.tension == 0 && cortex.bending == 0;
  if (is_bare && space_.inner_pressure() < 0) return;
  const std::vector<int>& place = workspace.place;
  const ElementSystem& of_patch = workspace.surface;
  for (const int patch : cortex_.patches_of(element)) {
    cortex_.integrate(patch, cortex, at.unknowns, at.want, workspace.surface);
    const Eigen::MatrixXi &rows = cortex_.equations_of(patch), &columns = cortex_.unknowns_of(patch);
    for (int i = 0; i < int(rows.size()); ++i) sum.add(rows(i), of_patch.residual(i));
    for (int j = 0; j < int(columns.size()) && at.want == Want::residual_and_tangent; ++j) {
      if (columns(j) < 0) continue;
      for (int i = 0; i < int(rows.size()); ++i) {
        if (rows(i) >= 0) workspace.matrix(place[rows(i)], place[columns(j)]) += float(of_patch.tangent(i, j));
      }
    }
  }
}

double DuctSystem::largest_displacement(const VectorXd& unknowns) const {
  double largest = 0;
  for (int i = 0; i < 3 * space_.nodes().count; ++i) {
    if (const int unknown = space_.displacement(i / 3, i % 3); unknown >= 0)
      largest = std::max(largest, std::abs(unknowns(unknown)));
  }
  return largest;
}

void DuctSystem::scale_displacement(double factor, VectorXd& unknowns) const {
  std::vector<bool> scaled(space_.unknowns(), false);  // a tied unknown only once
  for (int i = 0; i < 3 * space_.nodes().count; ++i) {
    const int unknown = space_.displacement(i / 3, i % 3);
    if (unknown < 0 || scaled[unknown]) continue;
    unknowns(unknown) *= factor;
    scaled[unknown] = true;
  }
}

double DuctSystem::stretch_change(const VectorXd& from, const VectorXd& to) const {
  return duct_stretch_change(space_, from, to);
}

}  // namespace rheocyte
