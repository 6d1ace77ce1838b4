#include "numeric/dense_solve.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

namespace rheocyte {

Eigen::MatrixXd solve_dense(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b) { return A.partialPivLu().solve(b); }

Eigen::MatrixXd dense_inverse(const Eigen::MatrixXd& A) {
  return solve_dense(A, Eigen::MatrixXd::Identity(A.rows(), A.cols()));
}

Eigen::MatrixXd regular_inverse(const Eigen::MatrixXd& A) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(A);
  return lu.isInvertible() ? Eigen::MatrixXd(lu.inverse()) : Eigen::MatrixXd();
}

Eigen::VectorXd null_vector(const Eigen::MatrixXd& A) { return A.fullPivLu().kernel().col(0); }

Eigen::MatrixXd whitening(const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
  if (cholesky.info() != Eigen::Success) return {};
  return cholesky.matrixL().solve(Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols()));
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.colPivHouseholderQr().solve(b);
}

}  // namespace rheocyte
