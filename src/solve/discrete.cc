#include "solve/discrete.h"

namespace rheocyte {
namespace {

/// A mesh is worn where its quality has fallen to this fraction of what it was, and worth fitting where that raises it
/// so much.
constexpr double worn = 0.5, worthwhile = 1.2;

}  // namespace

bool Discrete::is_worn(const VectorXd& unknowns) const { return mesh_quality(unknowns) < worn * first_quality_; }

std::shared_ptr<Discrete> Discrete::fitted(const VectorXd& unknowns, Elements elements) const {
  const auto found = made_as(*this, elements == Elements::even ? &unknowns : nullptr);
  const VectorXd carried = found->transfer_from(*this, unknowns);
  found->fit(carried);
  found->is_fitted_ = true;
  found->first_quality_ = found->mesh_quality(carried);
  return found->first_quality_ > worthwhile * mesh_quality(unknowns) ? found : nullptr;
}

std::shared_ptr<Discrete> Discrete::fitted_as(const Discrete& other) const {
  if (!other.is_fitted_) return nullptr;
  const auto made = made_as(other, nullptr);
  made->is_fitted_ = true;
  made->first_quality_ = other.first_quality_;
  return made;
}

}  // namespace rheocyte
