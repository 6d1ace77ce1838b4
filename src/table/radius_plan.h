// Which branches of a table are computed, and which lie between computed ones (docs/theory.md, sec. "tables").
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "table/branch_line.h"
#include "table/table_spec.h"

namespace rheocyte {

/// A branch of a table: its place, and whether it is the one that bending holds beyond the end of the bare surface.
struct BranchTask {
  int place = 0;
  bool regularised = false;
  auto operator<=>(const BranchTask&) const = default;
};

/// Whether the spec wants more where `own` ended: its bare surface lost stability there.
bool can_be_regularised(const TableSpec&, const SampledBranch& own);

/// First some radii, denser towards both ends; then, round by round, those in the middle of neighbours between which
/// polynomials are not accurate. The choice depends on finished records alone: all that take part make the same one.
/// Of combined cells, and in a square channel, all branches are computed.
class RadiusPlan {
 public:
  using Branch = std::shared_ptr<const SampledBranch>;
  /// The record of a branch; nothing if it is not finished.
  using Records = std::function<Branch(const BranchTask&)>;

  RadiusPlan(const TableSpec&, Records);

  /// Looks at the records; true once every branch of the table is computed or lies between computed ones.
  bool update();
  /// Branches that are to be computed and had no record, as far as that is known.
  const std::vector<BranchTask>& missing() const { return missing_; }
  /// The branch, computed or interpolated, once that is known; nothing before. Empty where there are no states.
  Branch branch(const BranchTask& task) const;

 private:
  /// Computed branches of one kind, by place.
  using Nodes = std::map<int, Branch>;
  /// Round by round; true if no branch of this kind is unknown any more.
  bool settle(bool regularised);
  std::vector<int> places_at_first() const;
  /// Whether the held branch of a place is requested; nothing while that is not known.
  std::optional<bool> wants_regularised(int place) const;
  /// Adds the branches of some places to the nodes; false if some are missing.
  bool find(const std::vector<int>& places, bool regularised, Nodes& nodes);
  /// The places that are computed next; none once the branches between the nodes are known.
  std::vector<int> next_places(const Nodes& nodes, bool regularised);
  /// Computes the branches between the nodes; returns the places where that cannot be done.
  std::vector<int> lie_between(const BranchLine&, bool regularised);

  TableSpec spec_;
  std::vector<SweepPoint> places_;
  Records records_;
  std::map<BranchTask, Branch> known_;  ///< computed or interpolated
  std::vector<BranchTask> missing_;
  bool complete_ = false;
};

}  // namespace rheocyte
