// The threads that compute a table: as many as processors, or the share of one rank under mpirun or srun.
#pragma once
#include <atomic>
#include <functional>

#include "table/table_folder.h"

namespace rheocyte {

/// This process among several that were started with the same command; {0, 1} if it is alone. From the environment
/// that Open MPI, MPICH and Slurm set.
struct Rank {
  int number = 0, count = 1;
};
Rank rank_from_environment();

/// Processors that this process may use.
int available_processors();

/// What is told meanwhile, by the thread that called.
struct TableObserver {
  std::function<void(int done)> done;  ///< branches, several times a second
  std::function<void()> waits;         ///< once, when all that is left is computed by other processes
};

/// Works on a table's folder in `jobs` threads until no branch is missing, be it computed here or by another process on
/// the folder, or `stop` is set; false if that ended it. What a thread cannot go on with is thrown here, once.
bool work_on_table(const TableFolder& folder, int jobs, const TableObserver& observer, const std::atomic<bool>& stop);

}  // namespace rheocyte
