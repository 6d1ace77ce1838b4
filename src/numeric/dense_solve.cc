#include "numeric/dense_solve.h"

#include <Eigen/LU>
#include <Eigen/QR>

namespace rheocyte {

Eigen::MatrixXd solve_dense(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b) { return A.partialPivLu().solve(b); }

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.colPivHouseholderQr().solve(b);
}

}  // namespace rheocyte
