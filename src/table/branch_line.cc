#include "table/branch_line.h"

#include "table/branch_between.h"

namespace rheocyte {

namespace {

constexpr std::size_t stencil_size = 8, min_stencil = 4;
constexpr auto nobody = static_cast<std::size_t>(-1);
/// Of the accuracy: a branch that is left out may be missed by so much, relative in the stiffness. Polynomials at half
/// of the distance miss by less than a fiftieth of that.
constexpr double max_miss = 2;
/// Of the deformation at the end of a branch that is left out.
constexpr double max_miss_of_end = 0.05;
const std::string without_states = "empty";

}  // namespace

BranchLine::BranchLine(const TableSpec& spec, const std::map<int, std::shared_ptr<const SampledBranch>>& branches)
    : spec_(spec) {
  for (const auto& [place, branch] : branches) nodes_.push_back({place, branch, family_of(*branch)});
  for (std::size_t k = 1; k + 1 < nodes_.size(); ++k) predict(k);
}

void BranchLine::predict(std::size_t node) {
  Node& here = nodes_[node];
  if (here.branch->empty()) return;
  if (nodes_[node - 1].family != here.family || nodes_[node + 1].family != here.family) return;
  const auto near = stencil(node - 1, node);
  here.has_neighbours = near.size() >= min_stencil;
  if (!here.has_neighbours) return;
  const BranchDifference off = difference(spec_, near, *here.branch);
  here.is_predicted = off.stiffness < max_miss * spec_.accuracy && off.end < max_miss_of_end;
}

bool BranchLine::is_smooth(std::size_t gap) const {
  const Node &a = nodes_[gap], &b = nodes_[gap + 1];
  if (a.family != b.family) return false;
  if (a.family == without_states) return true;
  const auto is_good = [](const Node& node) { return node.is_predicted || !node.has_neighbours; };
  return (a.has_neighbours || b.has_neighbours) && is_good(a) && is_good(b);
}

std::shared_ptr<const SampledBranch> BranchLine::between(std::size_t gap, double radius_um) const {
  if (nodes_[gap].family == without_states) return nodes_[gap].branch;
  SampledBranch branch = branch_between(spec_, stencil(gap, nobody), radius_um);
  return branch.empty() ? nullptr : std::make_shared<SampledBranch>(std::move(branch));
}

/// As many as there are on both sides of a gap, of the family of the node before it.
std::vector<const SampledBranch*> BranchLine::stencil(std::size_t gap, std::size_t left_out) const {
  const std::string& family = nodes_[gap].family;
  std::vector<const SampledBranch*> near;
  auto low = static_cast<std::ptrdiff_t>(gap), high = low + (left_out == gap + 1 ? 2 : 1);
  const auto fits = [&](std::ptrdiff_t k) {
    return k >= 0 && k < std::ssize(nodes_) && nodes_[static_cast<std::size_t>(k)].family == family;
  };
  for (bool down = true, up = true; (down || up) && near.size() < stencil_size;) {
    down = down && fits(low);
    if (down) near.insert(near.begin(), nodes_[static_cast<std::size_t>(low--)].branch.get());
    up = up && near.size() < stencil_size && fits(high);
    if (up) near.push_back(nodes_[static_cast<std::size_t>(high++)].branch.get());
  }
  return near;
}

}  // namespace rheocyte
