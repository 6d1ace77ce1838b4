// Computed branches of one kind in the order of their radii, and what lies between them.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// A gap has the number of the node before it.
class BranchLine {
 public:
  /// By place in the table.
  BranchLine(const TableSpec&, const std::map<int, std::shared_ptr<const SampledBranch>>& branches);

  std::size_t gaps() const { return nodes_.size() - 1; }
  int place(std::size_t node) const { return nodes_[node].place; }
  /// Whether polynomials across a gap are accurate: its two ends, or the one of which this can be determined, are what
  /// the other branches predict.
  bool is_smooth(std::size_t gap) const;
  /// The branch of a radius in a smooth gap; empty where its neighbours have no states, nothing if it cannot be
  /// determined.
  std::shared_ptr<const SampledBranch> between(std::size_t gap, double radius_um) const;

 private:
  struct Node {
    int place;
    std::shared_ptr<const SampledBranch> branch;
    std::string family;
    bool has_neighbours = false;  ///< of its family, on both sides
    bool is_predicted = false;    ///< by them, within what is admitted
  };
  void predict(std::size_t node);
  std::vector<const SampledBranch*> stencil(std::size_t gap, std::size_t left_out) const;

  TableSpec spec_;
  std::vector<Node> nodes_;
};

}  // namespace rheocyte
