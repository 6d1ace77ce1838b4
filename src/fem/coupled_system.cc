#include "fem/coupled_system.h"

#include <algorithm>
#include <limits>

#include "fem/end_loads.h"
#include "fem/observe.h"

namespace rheocyte {
/// One element's elimination: inner unknowns belong to it alone, outer ones couple it to others.
struct CoupledSystem::Condensed {
  std::vector<int> inner_row, inner_column, inner_unknown;  ///< slots, and the unknown of each
  std::vector<int> outer_row, outer_equation;               ///< slots, and the equation of each
  std::vector<int> outer_unknown;                           ///< each once
  struct Gather {
    int slot, outer;
  };
  std::vector<Gather> outer_column;  ///< column slots that add to an outer unknown
  std::vector<int> position;         ///< in the sparse matrix: outer_equation x outer_unknown

  Eigen::PartialPivLU<MatrixXd> lu;
  MatrixXd inner_outer, outer_inner, schur;  ///< Kii^-1 Kio, Koi, Koo - Koi Kii^-1 Kio
  VectorXd inner_solution;

  Condensed(const ElementUnknowns&, int outer_unknowns);
};

CoupledSystem::Condensed::Condensed(const ElementUnknowns& element, int outer_unknowns) {
  const int offset = element.liquid ? 2 * element.position_columns : 0;
  for (int i = 0; i < int(element.rows.size()); ++i) {
    const int unknown = element.rows[i];
    if (unknown >= outer_unknowns) {
      inner_row.push_back(i);
      inner_column.push_back(i + offset);
      inner_unknown.push_back(unknown);
    } else if (unknown >= 0) {
      outer_row.push_back(i);
      outer_equation.push_back(unknown);
    }
  }
  for (int j = 0; j < int(element.columns.size()); ++j) {
    const Slot& slot = element.columns[j];
    if (slot.unknown < 0 || slot.unknown >= outer_unknowns) continue;
    const auto it = std::find(outer_unknown.begin(), outer_unknown.end(), slot.unknown);
    outer_column.push_back({j, int(it - outer_unknown.begin())});
    if (it == outer_unknown.end()) outer_unknown.push_back(slot.unknown);
  }
}

CoupledSystem::CoupledSystem(const Discretisation& space, std::vector<ElementUnknowns> elements)
    : space_(space), elements_(std::move(elements)), surface_(space) {
  std::vector<std::pair<int, int>> entries;
  for (const ElementUnknowns& element : elements_) {
    const Condensed& c = condensed_.emplace_back(element, space.outer_unknowns());
    for (const int i : c.outer_equation) {
      for (const int j : c.outer_unknown) entries.emplace_back(i, j);
    }
  }
  for (int i = 0; i < space.outer_unknowns(); ++i) entries.emplace_back(i, i);
  const VectorXd inlet = inlet_load(space);
  for (int i = 0; i < inlet.size(); ++i) {
    if (inlet(i) != 0) inlet_equation_.push_back(i);
  }
  for (const int i : inlet_equation_) entries.emplace_back(i, space.cell_velocity());
  for (const SurfacePatch& patch : surface_.patches()) {
    for (const int i : patch.unknowns) {
      for (const int j : patch.unknowns) {
        if (i >= 0 && j >= 0) entries.emplace_back(i, j);
      }
    }
  }
  matrix_ = std::make_unique<SparseMatrix>(space.outer_unknowns(), entries);
  for (Condensed& c : condensed_) matrix_->append_positions(c.outer_equation, c.outer_unknown, c.position);
  for (const SurfacePatch& patch : surface_.patches()) {
    auto& positions = surface_position_.emplace_back();
    for (const int i : patch.unknowns) {
      for (const int j : patch.unknowns) positions.push_back(i < 0 || j < 0 ? -1 : matrix_->position(i, j));
    }
  }
  for (const int i : inlet_equation_) inlet_position_.push_back(matrix_->position(i, space.cell_velocity()));
  lu_ = std::make_unique<SparseLU>(*matrix_);
}

CoupledSystem::~CoupledSystem() = default;

void CoupledSystem::follow_space(std::vector<ElementUnknowns> elements) {
  elements_ = std::move(elements);
  surface_ = SurfaceIntegrals(space_);
}

std::size_t CoupledSystem::memory_bytes() const {
  std::size_t numbers = matrix_->value.size() + std::size_t(1.5 * lu_->entries());  // with the places of the entries
  for (const Condensed& c : condensed_)
    numbers += c.lu.matrixLU().size() + c.inner_outer.size() + c.outer_inner.size() + c.schur.size();
  for (const ElementUnknowns& element : elements_) {
    if (!element.liquid || !element.position) continue;  // elements of the cell share theirs
    for (const auto& table : element.position->at_points)
      numbers += table.value.size() + table.slope[0].size() + table.slope[1].size();
  }
  return numbers * sizeof(double);
}

VectorXd CoupledSystem::sphere() const {
  VectorXd unknowns = VectorXd::Zero(space_.unknowns());
  unknowns(space_.cell_velocity()) = 1;
  return unknowns;
}

double CoupledSystem::cell_radius() const { return space_.mesh().geometry().radius(); }

double CoupledSystem::largest_displacement(const VectorXd& unknowns) const {
  return rheocyte::largest_displacement(space_, unknowns);
}

void CoupledSystem::scale_displacement(double factor, VectorXd& unknowns) const {
  rheocyte::scale_displacement(space_, factor, unknowns);
}

double CoupledSystem::stretch_change(const VectorXd& from, const VectorXd& to) const {
  return rheocyte::stretch_change(space_, from, to);
}

VectorXd CoupledSystem::residual(const Media& media, const VectorXd& unknowns, double& min_det) {
  const Stopwatch watch(work_.assembly_s);
  VectorXd total = VectorXd::Zero(space_.unknowns());
  min_det = std::numeric_limits<double>::infinity();
  for (int e = 0; e < int(condensed_.size()); ++e) {
    if (elements_[e].is_empty()) continue;
    integrate(e, media, unknowns, Want::residual, element_);
    min_det = std::min(min_det, element_.min_det);
    const auto& rows = elements_[e].rows;
    for (int i = 0; i < int(rows.size()); ++i) {
      if (rows[i] >= 0) total(rows[i]) += element_.residual(i);
    }
  }
  add_ends(media, unknowns, Want::residual, total);
  add_surface(media.cortex, unknowns, Want::residual, total);
  return total;
}

VectorXd CoupledSystem::linearise(const Media& media, const VectorXd& unknowns, double& min_det, bool& factorised) {
  VectorXd total = VectorXd::Zero(space_.unknowns());
  std::fill(matrix_->value.begin(), matrix_->value.end(), 0.0);
  min_det = std::numeric_limits<double>::infinity();
  for (int e = 0; e < int(condensed_.size()); ++e) {
    if (elements_[e].is_empty()) continue;
    {
      const Stopwatch watch(work_.assembly_s);
      integrate(e, media, unknowns, Want::residual_and_tangent, element_);
    }
    min_det = std::min(min_det, element_.min_det);
    const auto& rows = elements_[e].rows;
    for (int i = 0; i < int(rows.size()); ++i) {
      if (rows[i] >= 0) total(rows[i]) += element_.residual(i);
    }
    const Stopwatch watch(work_.condensation_s);
    condense(elements_[e], condensed_[e], element_.tangent);
  }
  add_ends(media, unknowns, Want::residual_and_tangent, total);
  add_surface(media.cortex, unknowns, Want::residual_and_tangent, total);
  const Stopwatch watch(work_.sparse_s);
  factorised = lu_->factorise();
  ++work_.factorisations;
  return total;
}

double CoupledSystem::undisturbed_pressure(const Liquid& liquid) const {
  if (!(undisturbed_ && undisturbed_->first == liquid))
    undisturbed_ = {liquid, undisturbed_inlet_pressure(space_, liquid)};
  return undisturbed_->second;
}

CoupledSystem::InletPressure CoupledSystem::inlet_pressure(const Media& media) const {
  return {undisturbed_pressure(media.liquid), 0};
}

void CoupledSystem::add_ends(const Media& media, const VectorXd& unknowns, Want want, VectorXd& residual) {
  // Loads are those of this moment: the ends of a channel with walls that are not straight change their size.
  residual -= undisturbed_pressure(media.liquid) * outlet_load(space_);
  if (!space_.has_open_inlet()) return;
  const InletPressure pressure = inlet_pressure(media);
  const VectorXd load = inlet_load(space_);
  residual += (pressure.fixed + pressure.slope * unknowns(space_.cell_velocity())) * load;
  if (want == Want::residual) return;
  for (std::size_t k = 0; k < inlet_equation_.size(); ++k) {
    matrix_->value[inlet_position_[k]] += pressure.slope * load(inlet_equation_[k]);
  }
}

void CoupledSystem::condense(const ElementUnknowns& element, Condensed& c, const MatrixXd& tangent) {
  const int inner = int(c.inner_row.size()), rows = int(c.outer_row.size()), columns = int(c.outer_unknown.size());
  const MatrixXd inner_inner = tangent(c.inner_row, c.inner_column);
  c.outer_inner = tangent(c.outer_row, c.inner_column);
  c.inner_outer.setZero(inner, columns);
  c.schur.setZero(rows, columns);
  for (const auto& [slot, outer] : c.outer_column) {
    const double factor = element.columns[slot].factor;
    for (int i = 0; i < inner; ++i) c.inner_outer(i, outer) += factor * tangent(c.inner_row[i], slot);
    for (int i = 0; i < rows; ++i) c.schur(i, outer) += factor * tangent(c.outer_row[i], slot);
  }
  if (inner > 0) {
    c.lu.compute(inner_inner);
    c.inner_outer = c.lu.solve(c.inner_outer);
    c.schur.noalias() -= c.outer_inner * c.inner_outer;
  }
  const double* value = c.schur.data();
  for (const int position : c.position) matrix_->value[position] += *value++;
}

VectorXd CoupledSystem::solve(const VectorXd& rhs) {
  const Stopwatch watch(work_.solve_s);
  VectorXd outer = rhs.head(space_.outer_unknowns());
  for (Condensed& c : condensed_) {
    if (c.inner_unknown.empty()) continue;
    c.inner_solution = c.lu.solve(VectorXd(rhs(c.inner_unknown)));
    const VectorXd correction = c.outer_inner * c.inner_solution;
    for (int i = 0; i < correction.size(); ++i) outer(c.outer_equation[i]) -= correction(i);
  }
  VectorXd x(space_.unknowns());
  x.head(space_.outer_unknowns()) = lu_->solve(outer);
  for (const Condensed& c : condensed_) {
    if (c.inner_unknown.empty()) continue;
    const VectorXd inner = c.inner_solution - c.inner_outer * x(c.outer_unknown);
    for (int i = 0; i < inner.size(); ++i) x(c.inner_unknown[i]) = inner(i);
  }
  return x;
}

void CoupledSystem::add_surface(const Cortex& cortex, const VectorXd& unknowns, Want want, VectorXd& residual) {
  const Stopwatch watch(work_.assembly_s);
  for (int k = 0; k < surface_.active(cortex); ++k) {
    surface_.integrate(k, cortex, unknowns, want, element_);
    const auto& rows = surface_.patches()[k].unknowns;
    for (int i = 0; i < int(rows.size()); ++i) {
      if (rows[i] < 0) continue;
      residual(rows[i]) += element_.residual(i);
      if (want == Want::residual) continue;
      for (int j = 0; j < int(rows.size()); ++j) {
        if (rows[j] >= 0) matrix_->value[surface_position_[k][i * rows.size() + j]] += element_.tangent(i, j);
      }
    }
  }
}

VectorXd CoupledSystem::apply_tangent(const Media& media, const VectorXd& unknowns, const VectorXd& direction) {
  VectorXd product = VectorXd::Zero(space_.unknowns());
  for (int e = 0; e < int(condensed_.size()); ++e) {
    const ElementUnknowns& element = elements_[e];
    if (element.is_empty()) continue;
    integrate(e, media, unknowns, Want::residual_and_tangent, element_);
    VectorXd local(element.columns.size());
    for (int j = 0; j < local.size(); ++j) {
      const Slot& slot = element.columns[j];
      local(j) = slot.unknown >= 0 ? slot.factor * direction(slot.unknown) : 0.0;
    }
    const VectorXd change = element_.tangent * local;
    for (int i = 0; i < change.size(); ++i) {
      if (element.rows[i] >= 0) product(element.rows[i]) += change(i);
    }
  }
  if (space_.has_open_inlet())
    product += inlet_pressure(media).slope * direction(space_.cell_velocity()) * inlet_load(space_);
  for (int k = 0; k < surface_.active(media.cortex); ++k) {
    surface_.integrate(k, media.cortex, unknowns, Want::residual_and_tangent, element_);
    const auto& rows = surface_.patches()[k].unknowns;
    for (int i = 0; i < int(rows.size()); ++i) {
      for (int j = 0; j < int(rows.size()); ++j) {
        if (rows[i] >= 0 && rows[j] >= 0) product(rows[i]) += element_.tangent(i, j) * direction(rows[j]);
      }
    }
  }
  return product;
}

}  // namespace rheocyte
