// One case in a square duct on its way: along the branch at low degrees, then to ever higher ones
// (docs/theory-square.md, sec. accuracy).
#pragma once
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "solve/continuation.h"
#include "solve/describe_duct.h"
#include "solve/stationary.h"

namespace rheocyte {

/// A state, how it was resolved, and how the way to it ended.
struct DuctState {
  Status status = Status::not_started;
  std::shared_ptr<DuctDiscrete> discrete;
  BranchState branch;  ///< its parameter is the compliance relative to the problem's
  double residual = 0;
};

/// A state at ever higher degrees.
struct DuctLadder {
  bool keeps_systems = false;  ///< of all rungs; or of the last one alone
  std::vector<DuctState> rungs = {};
  std::vector<double> deformations = {};                             ///< rung by rung
  std::vector<StateNumbers> numbers = {};                            ///< likewise
  double estimated_error = std::numeric_limits<double>::infinity();  ///< relative, of the last deformation

  void add(DuctState, const StateNumbers&);
  /// Of all numbers of the last rung, each in its unit.
  StateNumbers errors() const;
  /// The greatest relative error of the last velocity and spin, and of the drift at a given place; relative to 1e-4 of
  /// the velocity where it is less: so a cell would shift by 0.1 um on a way of 1 mm.
  double motion_error(CellPlace) const;
};

/// Along the branch the cell softens to what the problem says (`softening`), or as the caller says. What steps and work
/// there are is counted in a result, which must outlive the solver as problem, callback and stop must.
class DuctSolver {
 public:
  DuctSolver(const Problem& problem, MediaAt media, const ProgressCallback& progress, const std::atomic<bool>* stop,
             StationaryState& result)
      : problem_(problem), media_(std::move(media)), progress_(progress), stop_(stop), result_(&result) {}

  static constexpr int first_degree = 3, last_degree = 7;

  /// The problem of a state of the branch.
  Problem problem_at(double compliance) const;
  /// Its distance from the limit of stability (describe_duct.h).
  double stability_margin(double compliance, const DuctSpace&, const VectorXd& unknowns) const;
  /// Systems of all degrees are kept for the next states.
  void keep_systems() { keeps_systems_ = true; }
  /// A state beyond the limit of stability at any higher degree is none: near the limit those degrees take turns.
  void want_stable() { wants_stable_ = true; }
  /// From now on steps, errors and work belong to this result.
  void count_in(StationaryState& result) { result_ = &result; }

  /// From the sphere to the wanted compliance, or as far as the branch goes.
  DuctState follow();
  /// The first state of the branch at a degree that the options accept.
  DuctState enter(int degree, const ContinuationOptions&);
  /// As far as the branch goes, or to a compliance; `accept` as in ContinuationOptions.
  void advance(DuctState&, double compliance, const ContinuationOptions&);
  /// The same state at another degree.
  DuctState at_degree(const DuctState& from, int degree, const NewtonOptions&);
  /// Newton at a compliance from a guess at the degree of a state.
  DuctState at_compliance(const DuctState& near, double compliance, VectorXd guess);
  /// Raises the degree until the error is small: on from the ladder's last rung, or from the state, which becomes the
  /// last rung.
  Status climb(DuctState&, DuctLadder&);
  /// The ladder of a neighbouring problem `from` becomes this one's, whose factors serve for chord steps, as far as the
  /// accuracy needs it; or why not. Those factors are then with the new ladder.
  Status carry(const Problem& from, const DuctLadder& ladder, DuctLadder& carried);
  /// Along the branch, as long as the surface has the least margin; the last way looks for its end more closely.
  ContinuationOptions options(bool last, double least_margin = 0);

 private:
  DuctState scout();
  std::shared_ptr<DuctDiscrete> discrete(int degree);
  DuctState solved(std::shared_ptr<DuctDiscrete>, BranchState, const NewtonOptions&);
  bool is_stable(const DuctState&) const;
  /// Of the ladder's last rung, of what the problem wants accurately.
  double error_of(const DuctLadder&) const;
  void add(DuctState, DuctLadder&);
  DuctState moved(const Problem& from, const DuctState&);
  void take(DuctState&, const ContinuationReport&);
  void report(const BranchState&, double deformation, int degree);

  const Problem& problem_;
  MediaAt media_;
  const ProgressCallback& progress_;
  const std::atomic<bool>* stop_;
  StationaryState* result_;
  std::map<int, std::shared_ptr<DuctDiscrete>> discrete_;  ///< by degree
  bool keeps_systems_ = false, wants_stable_ = false;
};

}  // namespace rheocyte
