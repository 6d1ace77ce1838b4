// The branches of a table as work that several processes share.
#pragma once
#include "sweep/shared_work.h"
#include "table/table_folder.h"

namespace rheocyte {

/// A piece is a branch of the bare or of the held surface: 2 x its place in the sweep, + 1 if held.
BranchTask task_of_piece(int piece);

class TableWork final : public SharedWork {
 public:
  /// The folder must outlive the work.
  explicit TableWork(const TableFolder& folder) : folder_(folder) {}

  int pieces() const override { return folder_.branches(); }
  int done() const override { return folder_.done(); }
  std::vector<int> missing() const override;
  Claim claim(int piece) const override;
  bool has(int piece) const override;
  void compute(int piece, const std::atomic<bool>& stop) const override;

 private:
  const TableFolder& folder_;
};

}  // namespace rheocyte
