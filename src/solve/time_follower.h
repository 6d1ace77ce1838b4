// A cell followed along its way at one resolution, step by step, until its end or until it has settled.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "solve/stepper.h"
#include "solve/transient.h"

namespace rheocyte {

/// Times or places of another run, in order, at which the same numbers are requested of this one.
struct TimeProbe {
  bool by_place = false;
  std::vector<double> at;
  std::vector<TimePoint> seen = {};  ///< so far; behind the end of the run those of its last state
};

class TimeFollower {
 public:
  TimeFollower(const Problem&, const TimeRun&, const Resolution&, const TimeObserver&, const WorkLimits&);

  /// From the sphere, or from the state of an earlier run; fills the probes.
  StationaryState follow(const TimeStart* from, std::vector<TimeProbe>* probes = nullptr);

  bool has_settled() const { return settled_; }
  /// Whether the way was as long as requested.
  bool is_at_place() const;
  /// "12 % of the way": how far it has come.
  std::string fraction() const;

 private:
  Status resume(const TimeStart&);
  bool is_arrived() const;
  bool at_end() const { return settled_ || is_arrived(); }
  bool is_settled() const;
  void advance(StationaryState&);

  TimePoint describe(const TimeStepReport&) const;
  Problem problem_now() const { return with_media(stepper_->problem(), stepper_->media()); }
  /// The walls must be where they are at that time.
  void describe_level(const TimeLevel&, StationaryState&) const;
  StateNumbers numbers_of(const TimeLevel&) const;
  void add_inertia(const TimeLevel&, StateNumbers&) const;

  /// Time or place of a level, whichever the outputs follow.
  double progress(const TimeLevel& level) const { return run_.outputs_by_place ? level.place() : level.time; }
  void show_frame(const TimeLevel&) const;
  /// Those between the last step and the one before.
  void show_frames(double before) const;
  void fill(TimeProbe&) const;
  void fill_probes() const;
  std::string explanation(Status) const;

  TimeRun run_;
  int degree_;
  TimeObserver observer_;
  WorkLimits limits_;
  std::unique_ptr<Stepper> stepper_;
  std::vector<TimeProbe>* probes_ = nullptr;
  bool settled_ = false;
};

}  // namespace rheocyte
