// Events that are not of the kind of the others, and the moments of those that are.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "population/moment_model.h"

namespace rheocyte {

/// Mean and covariance of the events, which stand in rows, but for those that are left out.
Moments moments_of(const Eigen::MatrixXd& events, const std::vector<bool>& leave_out);

/// By their distance from the others, in units of these' scatter; again until the same ones are left out.
std::vector<bool> strangers(const Eigen::MatrixXd& events);

}  // namespace rheocyte
