// The folder of a table while it is computed: one record per branch, and which branches are requested.
#pragma once
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "store/work_folder.h"
#include "table/radius_plan.h"
#include "table/stiffness_grid.h"
#include "table/table_spec.h"

namespace rheocyte {

class TableFolder {
 public:
  static constexpr const char* tube_table_file = "tube-table.cbor";

  /// Makes the folder, or goes on in one that was begun with the same spec by a program that wants the same records;
  /// several processes may come at once. UserError if it belongs to another one, holds other files, or cannot be
  /// written.
  TableFolder(const std::filesystem::path& folder, const TableSpec&);

  const TableSpec& spec() const { return spec_; }
  const std::filesystem::path& path() const { return folder_.path(); }

  /// Of the table; not all of them are computed (radius_plan.h).
  int branches() const { return int(places_.size()); }
  const SweepPoint& place(int i) const { return places_[i]; }

  /// Before work goes on: reads every record that is there. UserError naming the first one that cannot be used, and how
  /// many there are; otherwise programs that want other records are refused from now on.
  void take_over() const;

  /// Branches that are computed, or lie between computed ones.
  int done() const;
  /// Branches that are to be computed and have no record, as far as that is known; none once the table is complete.
  std::vector<BranchTask> missing() const;
  /// As WorkFolder::claim.
  Claim claim(int i) const;
  /// Writes the record whole or not at all.
  void keep(int i, const SampledBranch&, bool regularised) const;
  bool has(int i, bool regularised) const;
  /// UserError naming the file if it is damaged or holds another cell than that of the place.
  SampledBranch read(int i, bool regularised) const;
  /// Computed or interpolated; only once that is known (asserted).
  SampledBranch branch(int i, bool regularised) const;
  /// All branches of a complete table, in the order of the places; held ones where they are requested. UserError naming
  /// the file if a record is damaged or missing.
  std::vector<SampledBranch> read_all() const;
  /// As WorkFolder::tidy.
  void tidy() const { folder_.tidy(); }
  /// Where the spec names the tube's table: its grid's file is kept in the folder, so that the table can be finished
  /// and read without it. UserError if a file that is there is damaged.
  bool lacks_tube() const;
  std::optional<GridContent> tube() const;
  /// All branches of the table itself: those of read_all, in a square channel dense ones between them.
  std::vector<SampledBranch> all_branches() const;
  /// As WorkFolder::publish.
  void publish(const std::string& name, std::string_view content) const { folder_.publish(name, content); }

 private:
  std::string record(int i, bool regularised) const;
  std::string layout() const;
  WantedWork wanted() const;
  bool update_plan() const;

  TableSpec spec_;
  std::string hash_;
  std::vector<SweepPoint> places_;
  WorkFolder folder_;
  mutable std::mutex plan_mutex_;
  mutable RadiusPlan plan_;
};

}  // namespace rheocyte
