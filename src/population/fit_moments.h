// Cells of several numbers each: their law is determined by mean and covariance of what is measured of the events of a
// recording (docs/theory-populations.md, eq:moments).
#pragma once
#include <Eigen/Core>
#include <vector>

#include "population/moment_model.h"
#include "store/watch.h"

namespace rheocyte {

struct MomentSettings {
  /// How well the model has the means of all events together: errors that more events do not make smaller.
  Eigen::MatrixXd common_covariance;
  Eigen::VectorXd least, greatest;  ///< within which the parameters are searched; equal: known
  int most_turns = 20;              ///< between the two parts
  Watch watch = {};                 ///< asked from step to step
};

struct MomentFit {
  bool is_found = false;  ///< else all of this is that of the last step
  Eigen::VectorXd parameters;
  std::vector<bool> at_bound;  ///< such a parameter of the scatter counts as known
  Eigen::MatrixXd covariance;  ///< of the parameters, by the scatter of the events, whatever their law is
  Eigen::MatrixXd by_shift;    ///< slopes of the parameters by a shift of the measures that all events have in common
  double misfit = 0;           ///< of the means: chi squared, with the common errors
  Moments fitted, measured;    ///< of the events that count
  std::vector<bool> is_stranger;  ///< by event: farther from the rest than cells of one kind are
  std::size_t events = 0;         ///< that count
};

/// The parameters that are means by the means of the events, which stand in rows, those of the scatter by their
/// covariance, in turn. A scatter of another kind than the law's hardly moves the means then, where it would in the
/// most likely normal distribution of both together. All events finite (asserted).
MomentFit fit_moments(const MomentModel& model, const Eigen::MatrixXd& events, const Eigen::VectorXd& start,
                      const MomentSettings& settings);

}  // namespace rheocyte
