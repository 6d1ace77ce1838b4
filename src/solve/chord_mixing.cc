#include "solve/chord_mixing.h"

#include "numeric/dense_solve.h"

namespace rheocyte {

VectorXd ChordMixing::correction(NonlinearSystem& system, const VectorXd& x, const VectorXd& residual) {
  if (steps_ == 0) return system.solve(-residual);
  if (last_.x.size() > 0) changes_.push_back({x - last_.x, residual - last_.residual});
  if (changes_.size() > steps_) changes_.erase(changes_.begin());
  last_ = {x, residual};
  if (changes_.empty()) return system.solve(-residual);
  Eigen::MatrixXd of_x(x.size(), Eigen::Index(changes_.size())), of_residual = of_x;
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    of_x.col(Eigen::Index(i)) = changes_[i].x;
    of_residual.col(Eigen::Index(i)) = changes_[i].residual;
  }
  const VectorXd fractions = least_squares(of_residual, residual);
  return system.solve(of_residual * fractions - residual) - of_x * fractions;
}

void ChordMixing::forget() {
  changes_.clear();
  last_ = {};
}

}  // namespace rheocyte
