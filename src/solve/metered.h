// How much work a branch's systems do, and until when.
#pragma once
#include "solve/resolved_branch.h"

namespace rheocyte {

/// While it lives, what a system works is counted, and the system gives up its work once it is to stop.
class ResolvedBranch::Metered {
 public:
  Metered(ResolvedBranch& branch, NonlinearSystem& system) : branch_(branch), system_(system), before_(system.work()) {
    system_.obey(branch.limits_);
  }
  ~Metered() {
    system_.obey({});
    branch_.statistics_ += system_.work() - before_;
  }
  Metered(const Metered&) = delete;
  Metered& operator=(const Metered&) = delete;

 private:
  ResolvedBranch& branch_;
  NonlinearSystem& system_;
  WorkMeter before_;
};

}  // namespace rheocyte
