// The processes that compute a table: as many as processors, or the share of one rank under mpirun or srun.
#pragma once
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

/// Why the processes ended.
struct ProcessesEnd {
  bool complete = false;
  int signal = 0;       ///< that this process received
  int worker_code = 0;  ///< of a worker that could not go on; its own words are on standard error
};

/// Starts workers on a table's folder and waits until nothing is left to do for them, on this machine or another. A
/// worker that is killed is replaced as long as the work goes on; workers that end while branches are missing on which
/// nobody works end it with a sentence. UserError if the solver is missing or of another build.
ProcessesEnd run_workers(const TableFolder& folder, int jobs, bool quiet);

}  // namespace rheocyte
