#include "solve/discrete.h"

namespace rheocyte {
namespace {

/// A mesh is worn where its quality has fallen to this fraction of its first one.
constexpr double worn = 0.5;

}  // namespace

bool Discrete::is_worn(const VectorXd& unknowns) const { return mesh_quality(unknowns) < worn * first_quality_; }

std::shared_ptr<Discrete> Discrete::fitted(const VectorXd& unknowns, double evenly, double gain) const {
  const auto found = evenly > 0 ? cut_again(unknowns, evenly) : made_as(*this);
  if (!found) return nullptr;
  const VectorXd carried = found->transfer_from(*this, unknowns);
  found->fit(carried);
  found->is_fitted_ = true;
  found->first_quality_ = found->mesh_quality(carried);
  const bool is_worthwhile = found->first_quality_ > gain * mesh_quality(unknowns) ||
                             found->surface_evenness(carried) > gain * surface_evenness(unknowns);
  return is_worthwhile ? found : nullptr;
}

std::shared_ptr<Discrete> Discrete::fitted_as(const Discrete& other) const {
  if (!other.is_fitted_) return nullptr;
  const auto made = made_as(other);
  made->is_fitted_ = true;
  made->first_quality_ = other.first_quality_;
  return made;
}

}  // namespace rheocyte
