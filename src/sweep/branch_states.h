// The states of one branch of a sweep, each at the resolution that its accuracy needs.
#pragma once
#include <array>
#include <atomic>
#include <memory>

#include "case/scales.h"
#include "solve/tube.h"
#include "sweep/measured_state.h"
#include "table/progress.h"
#include "table/table_spec.h"

namespace rheocyte {

/// A state at u = ln(first stiffness / stiffness).
struct BranchNode {
  double u = 0;
  int level = 0;               ///< of the resolutions
  VectorXd unknowns, tangent;  ///< d/du
  MeasuredState state;
  Eigen::VectorXd slope;  ///< d(value)/du
  Eigen::MatrixX2d contour_slope;
  double error = 0;  ///< estimated, relative, of what tells how far the flow has deformed the cell

  double at(Measure m) const { return state.value(int(m)); }
};

/// Finds states; how far apart they are is up to the caller.
class BranchStates {
 public:
  BranchStates(const TableSpec&, const SweepPoint&, const std::atomic<bool>* stop);

  double stiffness(double u) const;
  double log_progress(const BranchNode& node) const;
  double log_progress_slope(const BranchNode& node) const;

  /// How a way along the branch ended, and the farthest state, not measured yet.
  struct Way {
    Status status;
    BranchNode last;
  };
  /// The first state, at u = 0: that of a cell less deformed than the table's least deformation, or would be without
  /// the tension that elongates it.
  Way enter();
  /// Goes to `u` as far as the branch goes, at the resolution of `from`.
  Way advance(const BranchNode& from, double u);
  /// Measures a state with its slopes and its error, on finer meshes if need be; false if it is not accurate.
  bool measure(BranchNode&);
  /// Carries a state to the next level; false if there is none or the state does not hold there.
  bool refine(BranchNode&);
  /// Between two nodes of one level, by the cubic through both.
  double progress_in_the_middle(const BranchNode& a, const BranchNode& b);
  /// A state needs its own level and the one before, which tells its error; factors take some 100 MB on the others.
  void release_coarser_than(int level);

  int solves() const { return solves_; }
  int newton_iterations() const { return newton_iterations_; }
  int refused() const { return refused_; }
  double factorisation_seconds() const;

 private:
  static constexpr int levels = 5;

  Way enter_round();
  /// To the wanted axial ratio at the first stiffness.
  Way draw_out(const BranchNode& round);
  Problem problem(double u) const;
  TubeDiscrete& at_level(int level);
  Path path(int level, double end);
  ContinuationOptions continuation();
  double error_of(const BranchNode&);
  ShapeMeasures shape(int level, const VectorXd& unknowns);
  double progress(int level, const VectorXd& unknowns);
  void count(int iterations);

  TableSpec spec_;
  SweepPoint place_;
  double axial_ratio_;  ///< that is wanted; the place's own is the one that is reached
  NewtonOptions newton_;
  double first_stiffness_ = 1;
  std::array<std::unique_ptr<TubeDiscrete>, levels> discrete_;
  double released_factorisation_ = 0;
  int solves_ = 0, newton_iterations_ = 0, refused_ = 0;
};

}  // namespace rheocyte
