// The states of one branch of a sweep, each at the resolution that its accuracy needs.
#pragma once
#include <atomic>
#include <memory>
#include <vector>

#include "case/scales.h"
#include "sweep/branch_meshes.h"
#include "sweep/measured_state.h"
#include "table/progress.h"
#include "table/table_spec.h"

namespace rheocyte {

/// A state at u = ln(first stiffness / stiffness).
struct BranchNode {
  double u = 0;
  BranchMeshes* meshes = nullptr;
  int level = 0;               ///< of the meshes
  VectorXd unknowns, tangent;  ///< d/du
  MeasuredState state;
  Eigen::VectorXd slope;  ///< d(value)/du
  Eigen::MatrixX2d contour_slope;
  double progress_before =
      0;             ///< what measures how far the flow has deformed the cell, on the level before; 0: unknown
  double error = 0;  ///< estimated, relative, of what measures how far the flow has deformed the cell

  double at(Measure m) const { return state.value(int(m)); }
};

/// Finds states; how far apart they are is up to the caller.
class BranchStates {
 public:
  BranchStates(const TableSpec&, const SweepPoint&, const std::atomic<bool>* stop);

  double stiffness(double u) const;
  double log_progress(const BranchNode& node) const;
  double log_progress_slope(const BranchNode& node) const;
  /// Of the compliance, to which the progress is proportional at first.
  double power() const;
  /// Steps in u of states that the coarser mesh has and the finer one does not are halved down to this.
  double least_advance() const;

  /// How a way along the branch ended, and the farthest state, not measured yet.
  struct Way {
    Status status;
    BranchNode last;
  };
  /// The first state, at u = 0: that of a cell less deformed than the table's least deformation, or would be without
  /// the tension that elongates it.
  Way enter();
  /// Goes to `u` as far as the branch goes, at the resolution of `from`.
  Way walk(const BranchNode& from, double u);
  /// The same at less cost: on the way at the resolution before that of `from`, at the end at its own.
  Way advance(const BranchNode& from, double u);
  /// The state between two measured ones, at the resolution of the second.
  Way between(const BranchNode& a, const BranchNode& b, double u);
  /// Relative, of what measures how far the flow has deformed the cell: the spec's accuracy, and more where the branch
  /// is so steep that the modulus is as accurate for all that.
  double admitted_error(const BranchNode& node) const;
  /// Measures a state with its slopes and its error, on finer meshes if need be; false if it is not accurate.
  bool measure(BranchNode&);
  /// Carries a state to the next level; false if there is none or the state does not hold there.
  bool refine(BranchNode&);
  /// A part of the way between two measured nodes, in the compliance: of the cubic through their states.
  double log_progress_between(const BranchNode& a, const BranchNode& b, double part);
  /// A state needs its own level and the one before, which determines its error; factors take some 100 MB on the
  /// others.
  void release_coarser_than(const BranchNode&);

  int solves() const { return solves_; }
  int newton_iterations() const { return newton_iterations_; }
  int refused() const { return refused_; }
  double factorisation_seconds() const;

 private:
  Way enter_round();
  /// To the requested axial ratio at the first stiffness.
  Way draw_out(const BranchNode& round);
  Problem problem(double u) const;
  TubeDiscrete& discrete_of(const BranchNode& node) const { return node.meshes->at(node.level); }
  Path path(TubeDiscrete&, double end) const;
  ContinuationOptions continuation();
  /// A mesh is fitted to the state of a node; false if that does not help.
  bool fit(BranchNode&);
  /// The state at `u` from a guess, which it takes the place of if it is found.
  Status solve(TubeDiscrete&, double u, double tolerance, VectorXd& unknowns);
  void measure_with_slopes(BranchNode&, const Scales&);
  double error_of(const BranchNode&);
  /// On the mesh of b.
  VectorXd cubic_between(const BranchNode& a, const BranchNode& b, double part);
  double progress(const TubeDiscrete&, const VectorXd& unknowns) const;
  void count(int iterations);

  TableSpec spec_;
  SweepPoint place_;
  double axial_ratio_;  ///< that is requested; the place's own is the one that is reached
  NewtonOptions newton_;
  double first_stiffness_ = 1;
  std::vector<std::unique_ptr<BranchMeshes>> meshes_;  ///< the last one is that of the states ahead
  int solves_ = 0, newton_iterations_ = 0, refused_ = 0;
};

}  // namespace rheocyte
