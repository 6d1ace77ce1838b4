// Small dense systems of equations, compiled once: Eigen's factorisations take seconds in each source that has one.
#pragma once
#include <Eigen/Core>

namespace rheocyte {

/// The solution of A x = b, column by column; not finite if A is singular.
Eigen::MatrixXd solve_dense(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

/// The x that minimises |A x - b|.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace rheocyte
