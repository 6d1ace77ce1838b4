#include "sweep/table_work.h"

#include "state/outcome.h"
#include "sweep/sample_branch.h"

namespace rheocyte {

namespace {

int piece_of(const BranchTask& task) { return 2 * task.place + int(task.regularised); }

}  // namespace

BranchTask task_of_piece(int piece) { return {piece / 2, piece % 2 == 1}; }

std::vector<int> TableWork::missing() const {
  std::vector<int> pieces;
  for (const BranchTask& task : folder_.missing()) pieces.push_back(piece_of(task));
  return pieces;
}

Claim TableWork::claim(int piece) const { return folder_.claim(task_of_piece(piece).place); }

bool TableWork::has(int piece) const {
  return folder_.has(task_of_piece(piece).place, task_of_piece(piece).regularised);
}

void TableWork::compute(int piece, const std::atomic<bool>& stop) const {
  const auto [place, is_regularised] = task_of_piece(piece);
  const SampledBranch branch = is_regularised ? sample_regularised_branch(folder_.spec(), folder_.place(place),
                                                                          folder_.branch(place, false), &stop)
                                              : sample_branch(folder_.spec(), folder_.place(place), &stop);
  if (branch.end.status != Status::stopped) folder_.keep(place, branch, is_regularised);
}

}  // namespace rheocyte
