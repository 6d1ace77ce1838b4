// Mean and covariance of what is measured of cells, as functions of the parameters of their law
// (docs/theory-populations.md, eq:moments).
#pragma once
#include <Eigen/Core>
#include <vector>

namespace rheocyte {

/// Of some measures, with the noise of the pictures.
struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// With their slopes by each parameter.
struct MomentSlopes {
  Moments there;
  std::vector<Moments> by_parameter;
};

/// Moments as functions of the parameters of a law, first those that are its means, then those of its scatter.
class MomentModel {
 public:
  virtual ~MomentModel() = default;
  virtual Moments at(const Eigen::VectorXd& parameters) const = 0;
  virtual MomentSlopes slopes(const Eigen::VectorXd& parameters) const = 0;
  virtual int means() const = 0;
};

}  // namespace rheocyte
