// The folder of a dynamic table: a record of each cell that has been followed, and the table once it is complete.
#pragma once
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "store/work_folder.h"
#include "sweep/shared_work.h"
#include "table/dynamic_table.h"

namespace rheocyte {

/// A piece is a cell. An interrupted computation goes on where it was; several processes may share it.
class DynamicFolder final : public SharedWork {
 public:
  /// Makes the folder, or goes on in one that was begun with the same spec. UserError as of WorkFolder, or naming a
  /// record that is damaged.
  DynamicFolder(std::filesystem::path folder, DynamicSpec spec);

  int pieces() const override { return int(wanted_.size()); }
  int done() const override { return pieces() - int(missing().size()); }
  std::vector<int> missing() const override;
  Claim claim(int piece) const override;
  bool has(int piece) const override;
  void compute(int piece, const std::atomic<bool>& stop) const override;

  /// Of a complete folder. UserError naming the file if a record is damaged.
  std::vector<CellCourse> courses() const;

  /// Writes the table of a complete folder whose cells were all followed to the last place, and returns it. UserError.
  DynamicTable finish(std::vector<CellCourse> courses) const;

 private:
  CellCourse read(int piece) const;

  DynamicSpec spec_;
  std::string hash_;
  std::vector<DynamicCell> wanted_;
  WorkFolder folder_;
  mutable std::mutex known_mutex_;
  mutable std::vector<bool> known_;  ///< cells whose record was seen
};

/// Those that could not be followed to the last place.
std::vector<CellCourse> failed(const std::vector<CellCourse>&);

}  // namespace rheocyte
