// Work in pieces, each with a record in a folder, that threads of several processes share: branches and courses of
// tables.
#pragma once
#include <atomic>
#include <functional>
#include <vector>

#include "store/claim.h"

namespace rheocyte {

/// A folder of such work; its functions may be called by several threads at once.
class SharedWork {
 public:
  virtual ~SharedWork() = default;
  virtual int pieces() const = 0;
  virtual int done() const = 0;
  /// Numbers of the pieces that are to be done and have no record, as far as that is known; none once all is done.
  virtual std::vector<int> missing() const = 0;
  /// Nothing while somebody else works on the piece.
  virtual Claim claim(int piece) const = 0;
  virtual bool has(int piece) const = 0;
  /// Computes a piece and keeps its record, unless it is stopped.
  virtual void compute(int piece, const std::atomic<bool>& stop) const = 0;
};

/// This process among several that were started with the same command; {0, 1} if it is alone. From the environment
/// that Open MPI, MPICH and Slurm set.
struct Rank {
  int number = 0, count = 1;
};
Rank rank_from_environment();

/// Processors that this process may use: of one that is alone all; of a rank those that it was given, by Slurm's
/// --cpus-per-task or by a binding to a part of the machine, else one.
int available_processors(const Rank& = {});

/// What is reported meanwhile, by the thread that called.
struct WorkObserver {
  std::function<void(int done)> done;  ///< several times a second
  std::function<void()> waits;         ///< once, when all that is left is computed by other processes
};

/// Works in `jobs` threads until nothing is missing, be it computed here or by another process on the folder, or `stop`
/// is set; false if that ended it. What a thread cannot go on with is thrown here, once.
bool work_on(const SharedWork&, int jobs, const WorkObserver&, const std::atomic<bool>& stop);

}  // namespace rheocyte
