// The resolutions of a branch of a tube's table.
#pragma once
#include <array>
#include <memory>

#include "solve/tube.h"

namespace rheocyte {

/// Meshes, coarse to fine, whose liquid follows the cell alike: round the undeformed cell, or as one that was fitted to
/// a state. They are made when they are first asked for.
class BranchMeshes {
 public:
  static constexpr int levels = 6;

  explicit BranchMeshes(const Problem& problem, std::shared_ptr<const Discrete> fitted = nullptr)
      : problem_(problem), fitted_(std::move(fitted)) {}

  TubeDiscrete& at(int level);
  /// Frees the levels below the one before this one.
  void release_coarser_than(int level);
  void drop_factors();
  /// Of all that have been made.
  double factorisation_seconds() const;

 private:
  Problem problem_;
  std::shared_ptr<const Discrete> fitted_;
  std::array<std::shared_ptr<TubeDiscrete>, levels> discrete_;
  double released_factorisation_ = 0;
};

/// The part of the change from the level before that is taken as the error of a state.
double fraction_of_change(const Problem&, int level);

}  // namespace rheocyte
