#include "sweep/table_work.h"

#include "state/outcome.h"
#include "sweep/sample_branch.h"
#include "sweep/sample_square_branch.h"

namespace rheocyte {

namespace {

int piece_of(const BranchTask& task) { return 2 * task.place + int(task.held); }
BranchTask task_of(int piece) { return {piece / 2, piece % 2 == 1}; }

SampledBranch sampled(const TableFolder& folder, const BranchTask& task, const std::atomic<bool>& stop) {
  const TableSpec& spec = folder.spec();
  const BranchPlace place = folder.place(task.place);
  if (spec.is_square())
    return task.held ? sample_held_square_branch(spec, place, &stop) : sample_square_branch(spec, place, &stop);
  return task.held ? sample_held_branch(spec, folder.branch(task.place, false), &stop)
                   : sample_branch(spec, place, &stop);
}

}  // namespace

std::vector<int> TableWork::missing() const {
  std::vector<int> pieces;
  for (const BranchTask& task : folder_.missing()) pieces.push_back(piece_of(task));
  return pieces;
}

Claim TableWork::claim(int piece) const { return folder_.claim(task_of(piece).place); }

bool TableWork::has(int piece) const { return folder_.has(task_of(piece).place, task_of(piece).held); }

void TableWork::compute(int piece, const std::atomic<bool>& stop) const {
  const BranchTask task = task_of(piece);
  const SampledBranch branch = sampled(folder_, task, stop);
  if (branch.end.status != Status::stopped) folder_.keep(task.place, branch, task.held);
}

}  // namespace rheocyte
