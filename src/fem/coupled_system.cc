#include "fem/coupled_system.h"

#include <algorithm>
#include <limits>
#include <set>

#include "fem/end_loads.h"
#include "fem/observe.h"

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
    : space_(&space), elements_(std::move(elements)), surface_(space), place_(space.unknowns(), -1) {
  for (int e = 0; e < int(elements_.size()); ++e) {
    if (!elements_[e].is_empty()) parts_.push_back({e});
  }
  share_out_surface();
  share_out_inlet(inlet_load(space));
  lu_ = std::make_unique<NestedLU<double>>(space.unknowns(), couple());
  for (int k = 0; k < int(parts_.size()); ++k)
    places_.emplace_back(elements_[parts_[k].element], lu_->order(k), space.unknowns());
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

std::vector<CoupledUnknowns> CoupledSystem::couple() {
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
  return (has_factors_ ? lu_->memory_bytes() : 0) + numbers * sizeof(double);
}

void CoupledSystem::drop_factors() {
  lu_->drop_factors();
  has_factors_ = false;
}

VectorXd CoupledSystem::sphere() const {
  VectorXd unknowns = VectorXd::Zero(space_->unknowns());
  unknowns(space_->cell_velocity()) = 1;
  return unknowns;
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

Residual CoupledSystem::assemble(const Media& media, const VectorXd& unknowns, const UseTangent& use) {
  const Want want = use ? Want::residual_and_tangent : Want::residual;
  // Loads are those of this moment: the ends of a channel with walls that are not straight change their size.
  VectorXd total = -undisturbed_pressure(media.liquid) * outlet_load(*space_);
  const VectorXd load = inlet_load(*space_);
  InletPressure inlet;
  if (space_->has_open_inlet()) {
    inlet = inlet_pressure(media);
    total += (inlet.fixed + inlet.slope * unknowns(space_->cell_velocity())) * load;
  }
  double min_det = std::numeric_limits<double>::infinity();
  for (const int k : lu_->elements()) {
    const std::vector<int>& order = lu_->order(k);
    {
      const Stopwatch watch(work_.assembly_s);
      if (use) {
        const auto size = Eigen::Index(order.size());
        matrix_.setZero(size, size);
        for (int i = 0; i < int(size); ++i) place_[order[i]] = i;
      }
      add_element(k, media, unknowns, want, total);
      min_det = std::min(min_det, element_.min_det);
      add_surface(parts_[k], media.cortex, unknowns, want, total);
    }
    if (!use) continue;
    for (const int i : parts_[k].inlet) matrix_(place_[i], place_[space_->cell_velocity()]) += inlet.slope * load(i);
    const Stopwatch watch(work_.factorisation_s);
    use(k, order, matrix_);
  }
  return {std::move(total), min_det};
}

void CoupledSystem::add_element(int part, const Media& media, const VectorXd& unknowns, Want want, VectorXd& total) {
  const ElementUnknowns& element = elements_[parts_[part].element];
  integrate(parts_[part].element, media, unknowns, want, element_);
  for (int i = 0; i < int(element.rows.size()); ++i) {
    if (element.rows[i] >= 0) total(element.rows[i]) += element_.residual(i);
  }
  if (want == Want::residual_and_tangent) places_[part].add(element, element_.tangent, matrix_);
}

void CoupledSystem::add_surface(const Part& part, const Cortex& cortex, const VectorXd& unknowns, Want want,
                                VectorXd& total) {
  for (const int k : part.patches) {
    if (k >= surface_.active(cortex)) continue;
    surface_.integrate(k, cortex, unknowns, want, element_);
    const std::vector<int>& rows = surface_.patches()[k].unknowns;
    for (int j = 0; j < int(rows.size()); ++j) {
      if (rows[j] < 0) continue;
      total(rows[j]) += element_.residual(j);
      if (want == Want::residual) continue;
      for (int i = 0; i < int(rows.size()); ++i) {
        if (rows[i] >= 0) matrix_(place_[rows[i]], place_[rows[j]]) += element_.tangent(i, j);
      }
    }
  }
}

Residual CoupledSystem::residual(const Media& media, const VectorXd& unknowns) { return assemble(media, unknowns, {}); }

Residual CoupledSystem::linearise(const Media& media, const VectorXd& unknowns) {
  const auto condense = [this](int part, const std::vector<int>&, const MatrixXd& tangent) {
    lu_->condense(part, tangent);
  };
  Residual residual = assemble(media, unknowns, condense);
  has_factors_ = residual.value.allFinite() && lu_->is_regular();
  ++work_.factorisations;
  return residual;
}

VectorXd CoupledSystem::solve(const VectorXd& rhs) {
  const Stopwatch watch(work_.substitution_s);
  return lu_->solve(rhs);
}

double CoupledSystem::undisturbed_pressure(const Liquid& liquid) const {
  if (!(undisturbed_ && undisturbed_->first == liquid))
    undisturbed_ = {liquid, undisturbed_inlet_pressure(*space_, liquid)};
  return undisturbed_->second;
}

CoupledSystem::InletPressure CoupledSystem::inlet_pressure(const Media& media) const {
  return {undisturbed_pressure(media.liquid), 0};
}

VectorXd CoupledSystem::apply_tangent(const Media& media, const VectorXd& unknowns, const VectorXd& direction) {
  VectorXd product = VectorXd::Zero(space_->unknowns());
  const auto apply = [&](int, const std::vector<int>& order, const MatrixXd& tangent) {
    product(order) += tangent * direction(order);
  };
  assemble(media, unknowns, apply);
  return product;
}

}  // namespace rheocyte
