#include "fem/coupled_system.h"

#include <algorithm>
#include <set>

#include "fem/end_loads.h"
#include "fem/observe.h"
#include "laws/developed_flow.h"

namespace rheocyte {
namespace {

/// The first part whose element has all these nodes.
template <class Parts>
auto part_with(const Discretisation& space, Parts& parts, const std::vector<int>& nodes) {
  return std::find_if(parts.begin(), parts.end(), [&](const auto& part) {
    const std::vector<int>& own = space.nodes().of_element[part.element];
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](int node) { return std::find(own.begin(), own.end(), node) != own.end(); });
  });
}

}  // namespace

CoupledSystem::CoupledSystem(const Discretisation& space, std::vector<ElementUnknowns> elements)
    : AssembledSystem(space.unknowns(), space.cell_velocity()),
      space_(&space),
      elements_(std::move(elements)),
      surface_(space) {
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (!elements_[e].is_empty()) parts_.push_back({e});
  }
  share_out_surface();
  share_out_inlet(inlet_load(space));
  couple(coupled_unknowns());
  for (int k = 0; k < int(parts_.size()); ++k)
    places_.emplace_back(elements_[parts_[k].element], order(k), space.unknowns());
}

/// Each patch goes to an element at it: with liquid inside to one outside.
void CoupledSystem::share_out_surface() {
  const auto& edges = space_->surface();
  for (int k = 0; k < int(surface_.patches().size()); ++k) {
    const BoundaryEdge& edge = edges[k % edges.size()];  // vertices after the edges that they follow
    part_with(*space_, parts_, edge.nodes)->patches.push_back(k);
  }
}

void CoupledSystem::share_out_inlet(const VectorXd& load) {
  for (int i = 0; i < load.size(); ++i) {
    if (load(i) == 0) continue;
    const auto owner = std::find_if(parts_.begin(), parts_.end(), [&](const Part& part) {
      const std::vector<int>& rows = elements_[part.element].rows;
      return std::find(rows.begin(), rows.end(), i) != rows.end();
    });
    owner->inlet.push_back(i);
  }
}

std::vector<CoupledUnknowns> CoupledSystem::coupled_unknowns() {
  std::vector<CoupledUnknowns> coupled;
  std::vector<std::vector<int>> nodes;
  for (const Part& part : parts_) {
    const ElementUnknowns& element = elements_[part.element];
    std::set<int> unknowns(element.rows.begin(), element.rows.end());
    for (const Slot& slot : element.columns) unknowns.insert(slot.unknown);
    for (const int patch : part.patches) {
      const std::vector<int>& of_patch = surface_.patches()[patch].unknowns;
      unknowns.insert(of_patch.begin(), of_patch.end());
    }
    if (!part.inlet.empty()) unknowns.insert(space_->cell_velocity());
    unknowns.erase(-1);
    coupled.push_back({{unknowns.begin(), unknowns.end()}, space_->pressure(part.element, 0), element.liquid, {}});
    nodes.push_back(space_->nodes().of_element[part.element]);
  }
  set_neighbours(std::move(nodes), std::size_t(space_->reference().degree()) + 1, coupled);
  return coupled;
}

CoupledSystem::~CoupledSystem() = default;

void CoupledSystem::follow_space(const Discretisation& space, std::vector<ElementUnknowns> elements) {
  space_ = &space;
  elements_ = std::move(elements);
  surface_ = SurfaceIntegrals(space);
}

std::size_t CoupledSystem::memory_bytes() const {
  std::size_t numbers = 0;
  for (const ElementUnknowns& element : elements_) {
    if (!element.liquid || !element.position) continue;  // elements of the cell share theirs
    for (const auto& table : element.position->at_points)
      numbers += table.value.size() + table.slope[0].size() + table.slope[1].size();
  }
  return factor_bytes() + numbers * sizeof(double);
}

double CoupledSystem::cell_radius() const { return space_->mesh().geometry().radius(); }

double CoupledSystem::largest_displacement(const VectorXd& unknowns) const {
  return rheocyte::largest_displacement(*space_, unknowns);
}

void CoupledSystem::scale_displacement(double factor, VectorXd& unknowns) const {
  rheocyte::scale_displacement(*space_, factor, unknowns);
}

double CoupledSystem::stretch_change(const VectorXd& from, const VectorXd& to) const {
  return rheocyte::stretch_change(*space_, from, to);
}

/// Those of this moment: the ends of a channel with walls that are not straight change their size.
VectorXd CoupledSystem::loads(const Media& media, const VectorXd& unknowns) {
  VectorXd total = -undisturbed_pressure(media.liquid) * outlet_load(*space_);
  inlet_load_ = inlet_load(*space_);
  if (space_->has_open_inlet()) {
    const InletPressure inlet = inlet_pressure(media);
    inlet_slope_ = inlet.slope;
    total += (inlet.fixed + inlet.slope * unknowns(space_->cell_velocity())) * inlet_load_;
  }
  return total;
}

double CoupledSystem::add_part(int part, const At& at, PartResidual& sum, PartWorkspace<double>& workspace) const {
  add_element(part, at, sum, workspace);
  add_surface(parts_[part], at, sum, workspace);
  if (at.want == Want::residual_and_tangent) {
    const std::vector<int>& place = workspace.place;
    for (const int i : parts_[part].inlet)
      workspace.matrix(place[i], place[space_->cell_velocity()]) += inlet_slope_ * inlet_load_(i);
  }
  return workspace.element.min_det;
}

void CoupledSystem::add_element(int part, const At& at, PartResidual& sum, PartWorkspace<double>& workspace) const {
  const ElementUnknowns& element = elements_[parts_[part].element];
  integrate(parts_[part].element, at.media, at.unknowns, at.want, workspace.element);
  for (int i = 0; i < int(element.rows.size()); ++i) sum.add(element.rows[i], workspace.element.residual(i));
  if (at.want == Want::residual_and_tangent) places_[part].add(element, workspace.element.tangent, workspace.matrix);
}

void CoupledSystem::add_surface(const Part& part, const At& at, PartResidual& sum,
                                PartWorkspace<double>& workspace) const {
  const std::vector<int>& place = workspace.place;
  const ElementSystem& patch = workspace.surface;
  for (const int k : part.patches) {
    if (k >= surface_.active(at.media.cortex)) continue;
    surface_.integrate(k, at.media.cortex, at.unknowns, at.want, workspace.surface);
    const std::vector<int>& rows = surface_.patches()[k].unknowns;
    for (int j = 0; j < int(rows.size()); ++j) {
      if (rows[j] < 0) continue;
      sum.add(rows[j], patch.residual(j));
      if (at.want == Want::residual) continue;
      for (int i = 0; i < int(rows.size()); ++i) {
        if (rows[i] >= 0) workspace.matrix(place[rows[i]], place[rows[j]]) += patch.tangent(i, j);
      }
    }
  }
}

double CoupledSystem::undisturbed_pressure(const Liquid& liquid) const {
  if (!(undisturbed_gradient_ && undisturbed_gradient_->first == liquid))
    undisturbed_gradient_ = {liquid, undisturbed_pressure_gradient(liquid)};
  return undisturbed_gradient_->second * space_->mesh().geometry().end();
}

CoupledSystem::InletPressure CoupledSystem::inlet_pressure(const Media& media) const {
  return {undisturbed_pressure(media.liquid), 0};
}

}  // namespace rheocyte
