// Small dense systems of equations, compiled once: Eigen's factorisations take seconds in each source that has one.
#pragma once
#include <Eigen/Core>

namespace rheocyte {

/// The solution of A x = b, column by column; not finite if A is singular.
Eigen::MatrixXd solve_dense(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// A^-1; not finite if A is singular.
Eigen::MatrixXd dense_inverse(const Eigen::MatrixXd& A);

/// The same; empty if A is singular to rounding.
Eigen::MatrixXd regular_inverse(const Eigen::MatrixXd& A);

/// An x that is not 0 with A x = 0, where A has fewer rows than columns.
Eigen::VectorXd null_vector(const Eigen::MatrixXd& A);

/// L^-1 of the covariance L L^T of some numbers, which turns them into independent ones of variance 1; empty if the
/// covariance is not positive definite.
Eigen::MatrixXd whitening(const Eigen::MatrixXd& covariance);

/// The x that minimises |A x - b|.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace rheocyte
