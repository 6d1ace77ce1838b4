// The folder of a dynamic table: its spec, a record of each cell that has been followed, and the table once it is
// complete. An interrupted computation goes on where it was.
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "store/claim.h"
#include "table/dynamic_table.h"

namespace rheocyte {

class DynamicFolder {
 public:
  /// Makes the folder, or takes over what is there. UserError if it holds something else, another process works on it,
  /// or a record is damaged.
  DynamicFolder(std::filesystem::path folder, DynamicSpec spec);

  int cells() const { return int(courses_.size()); }
  int done() const { return done_; }

  /// Follows what is missing in so many threads; `tell` is called several times a second by the thread that called.
  /// False if `stop` ended it. UserError if the disk is full.
  bool compute(int jobs, const std::function<void(int done)>& tell, const std::atomic<bool>& stop);

  /// Cells that could not be followed to the last place.
  std::vector<CellCourse> failed() const;

  /// Of a complete folder without failed cells: writes the table and returns it. UserError.
  DynamicTable finish() const;
  /// Seconds that following the cells took, in all.
  double seconds() const;

 private:
  std::filesystem::path record(int i) const;
  void follow(int i, const std::atomic<bool>& stop);

  std::filesystem::path folder_;
  DynamicSpec spec_;
  std::string hash_;
  Claim claim_;
  std::vector<DynamicCell> wanted_;
  std::vector<CellCourse> courses_;  ///< not started: missing
  std::atomic<int> done_ = 0;
};

}  // namespace rheocyte
