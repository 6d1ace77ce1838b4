// The states of one case: along its branch on coarse resolutions, then from one resolution to the next finer one.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "solve/fit_on_the_way.h"
#include "solve/geometry.h"
#include "solve/ladder.h"
#include "solve/path.h"

namespace rheocyte {

/// How hard the end of a branch is looked for. Thorough: on all resolutions. Hopeful: not on the fine ones, which only
/// see a little more of the branch, if the coarse ones end far from the requested cell. Quick: on the coarse ones
/// alone, where the end is known anyway.
enum class Search { thorough, hopeful, quick };

/// Along the branch the cell softens to what the problem says, or as the caller says. States are reported as they are
/// found, those of a way that starts again once it is beyond what was reported. `stop` is polled once an iteration.
class ResolvedBranch {
 public:
  ResolvedBranch(const Problem& problem, Geometry geometry, ProgressCallback report = {}, const WorkLimits& limits = {})
      : ResolvedBranch(problem, softening(problem), std::move(geometry), std::move(report), limits) {}
  ResolvedBranch(const Problem&, MediaAt, Geometry, ProgressCallback, const WorkLimits&);

  /// Whether a state of the way is accepted.
  using Accept = std::function<bool(Discrete&, const BranchState&)>;

  /// The problem of a state of the branch.
  Problem problem_at(double compliance) const { return with_media(problem_, media_(compliance)); }
  const Geometry& geometry() const { return geometry_; }
  bool is_stopped() const { return limits_.is_stopped(); }
  /// Of all resolutions, for states to come.
  void keep_factors() { keeps_factors_ = true; }
  /// The work since it was asked for last; sizes are left alone.
  SolveStatistics take_statistics() { return std::exchange(statistics_, {}); }

  /// From the sphere to the requested compliance, or as far as the branch goes.
  ResolvedState follow(Search = Search::hopeful);
  /// The first state of the branch at a resolution.
  ResolvedState start(const Resolution&, const ContinuationOptions&, const Accept&);
  /// As far as the branch goes, or to a compliance. With one fit it ends as `mesh_folded` where the mesh is worn again.
  void advance(ResolvedState&, double compliance, const ContinuationOptions&, const Accept&, Fits = Fits::ever_again);
  /// Steps along the branch: which are accepted, the least of them.
  ContinuationOptions options(double min_step) const;
  /// A state that is not wrinkled.
  Accept smooth();
  /// How a state is found from a guess: Newton's method, or `newton_or_settle` from unknowns of another mesh.
  using FindState = NewtonReport (*)(NonlinearSystem&, const Media&, const NewtonOptions&, VectorXd&);
  /// At a compliance from a guess.
  ResolvedState solved(std::shared_ptr<Discrete>, double compliance, VectorXd guess, const NewtonOptions&,
                       FindState = newton);
  /// The same state at another resolution.
  ResolvedState at_resolution(const ResolvedState& from, const Resolution&);

  /// Raises degree and mesh from a state, or from the ladder's last rung, until the error is small: `converged`, or why
  /// not. The ladder is the last one that was climbed, the state its last rung.
  Status climb(ResolvedState&, Ladder&);
  bool is_accurate(const Ladder&) const;
  /// Whether a rung can only be compared with.
  bool only_begins(const ResolvedState&) const;
  /// Of a neighbouring problem, moved to this one as far as the accuracy needs it; or why not. The systems are those of
  /// the former ladder, which is lost but for its unknowns.
  Status carry(const Problem& from, const Ladder& former, Ladder&);

 private:
  class Metered;
  std::shared_ptr<Discrete> discretise(const Resolution&);
  ResolvedState carried(const ResolvedState& from, const Resolution&, const NewtonOptions&);
  ResolvedState enter(ResolvedState& from, const Resolution&, const ContinuationOptions&, const NewtonOptions& across);
  void take(const ContinuationReport&, ResolvedState&);
  /// Without fits; with pauses, until the mesh is worn.
  WayPoint go(ResolvedState&, double compliance, const ContinuationOptions&, const Accept&, bool pauses);
  /// From a state of a way towards the requested compliance.
  void go_on(ResolvedState&, const CoarseWay&, const ContinuationOptions&);
  /// Goes on by arc length from where a way has ended, round the fold if there is one (`limit_point`), or to the
  /// requested compliance; the state is the last one before the fold.
  void look_beyond(ResolvedState&, const ContinuationOptions&);
  /// Until the branch turns, the mesh is worn or the requested compliance is passed; whether a state was gained.
  bool trace(ResolvedState&, const ContinuationOptions&);
  /// Fits the mesh to the state; false if that does not help.
  bool fit(ResolvedState&, NewtonOptions);
  bool is_wrinkled(const ResolvedState&) const;
  bool has_collapsed(const ResolvedState&) const;
  bool is_nearly_unstable(const ResolvedState&) const;
  void add(const ResolvedState&, Ladder&) const;
  void report_last(const Ladder&);
  Status climb_on(const Rungs&, ResolvedState&, Ladder&);
  void report(Discrete&, const BranchState&, double deformation);

  Problem problem_;
  MediaAt media_;
  Geometry geometry_;
  ProgressCallback report_;
  WorkLimits limits_;
  SolveStatistics statistics_;
  std::vector<std::shared_ptr<Discrete>> made_;
  std::vector<ResolvedState> trail_;  ///< that the way has passed
  bool keeps_factors_ = false;
  double seen_ = 0;  ///< the greatest compliance that was reported
};

}  // namespace rheocyte
