#include "fem/subset_matrix.h"

#include <set>

namespace rheocyte {

SubsetMatrix::SubsetMatrix(const Discretisation& space, bool liquid) : number_(space.elements().size(), -1) {
  std::vector<CoupledUnknowns> coupled;
  std::vector<std::vector<int>> nodes;
  std::set<int> members;
  for (int e = 0; e < int(space.elements().size()); ++e) {
    const ElementUnknowns& element = space.elements()[e];
    if (element.liquid != liquid) continue;
    number_[e] = int(elements_.size());
    elements_.push_back(&element);
    std::set<int> unknowns;
    for (int j = element.liquid ? 2 * element.position_columns : 0; j < int(element.columns.size()); ++j)
      unknowns.insert(element.columns[j].unknown);
    unknowns.erase(-1);
    unknowns.erase(space.cell_velocity());
    members.insert(unknowns.begin(), unknowns.end());
    coupled.push_back({{unknowns.begin(), unknowns.end()}, space.pressure(e, 0), liquid, {}});
    nodes.push_back(space.nodes().of_element[e]);
  }
  members_.assign(members.begin(), members.end());
  set_neighbours(std::move(nodes), std::size_t(space.reference().degree()) + 1, coupled);
  lu_ = std::make_unique<NestedLU<double>>(space.unknowns(), coupled);
  for (int k = 0; k < int(elements_.size()); ++k) places_.emplace_back(*elements_[k], lu_->order(k), space.unknowns());
}

void SubsetMatrix::add(int element, const MatrixXd& tangent) {
  const int k = number_[element];
  const auto size = Eigen::Index(lu_->order(k).size());
  MatrixXd matrix = MatrixXd::Zero(size, size);
  places_[k].add(*elements_[k], tangent, matrix);
  lu_->condense(k, matrix);
}

VectorXd SubsetMatrix::solve(const VectorXd& rhs) const {
  VectorXd wanted = VectorXd::Zero(rhs.size());
  wanted(members_) = rhs(members_);
  return lu_->solve(wanted);
}

}  // namespace rheocyte
