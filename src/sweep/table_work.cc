#include "sweep/table_work.h"

#include "state/outcome.h"
#include "sweep/sample_branch.h"
#include "sweep/sample_square_branch.h"

namespace rheocyte {

namespace {

int piece_of(const BranchTask& task) { return 2 * task.place + int(task.held); }

}  // namespace

BranchTask task_of_piece(int piece) { return {piece / 2, piece % 2 == 1}; }

SampledBranch sample_task(const TableSpec& spec, const SweepPoint& place, bool held, const SampledBranch* bare,
                          const std::atomic<bool>& stop) {
  if (spec.is_square())
    return held ? sample_regularised_square_branch(spec, place, &stop) : sample_square_branch(spec, place, &stop);
  return held ? sample_regularised_branch(spec, *bare, &stop) : sample_branch(spec, place, &stop);
}

std::vector<int> TableWork::missing() const {
  std::vector<int> pieces;
  for (const BranchTask& task : folder_.missing()) pieces.push_back(piece_of(task));
  return pieces;
}

Claim TableWork::claim(int piece) const { return folder_.claim(task_of_piece(piece).place); }

bool TableWork::has(int piece) const { return folder_.has(task_of_piece(piece).place, task_of_piece(piece).held); }

void TableWork::compute(int piece, const std::atomic<bool>& stop) const {
  const BranchTask task = task_of_piece(piece);
  const SampledBranch bare = task.held ? folder_.branch(task.place, false) : SampledBranch();
  const SampledBranch branch = sample_task(folder_.spec(), folder_.place(task.place), task.held, &bare, stop);
  if (branch.end.status != Status::stopped) folder_.keep(task.place, branch, task.held);
}

}  // namespace rheocyte
