// What is measured of solids that are elongated along the flow, as the estimator of populations wants it
// (docs/theory-populations.md, sec. "Forward map"): one map for each elongation that is measured.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "infer/elongated_liquid.h"
#include "infer/outline_errors.h"
#include "infer/solid_features.h"
#include "population/forward_map.h"

namespace rheocyte {

/// By which cells are seen.
struct SolidImages {
  double pixel_size_um;
  std::shared_ptr<const OutlineErrors> outline = nullptr;  ///< null: none; for StiffnessMeasure::asymmetry alone
};

class SolidMaps {
 public:
  /// Of cells in this channel and flow, whose viscosity does not count; moduli are those at 1 mPa s. The table must
  /// outlive it.
  SolidMaps(const ElongatedLiquid& liquid, const ChannelFlow& flow, const SolidImages& images, StiffnessMeasure by);
  ~SolidMaps();
  SolidMaps(const SolidMaps&) = delete;
  SolidMaps& operator=(const SolidMaps&) = delete;

  StiffnessMeasure by() const { return by_; }
  /// Measured values of c_2 or the inertia ratio up to which the table goes: the least of stiff cells, the greatest of
  /// all. Of softer cells, which the flow itself elongates, the least is the one at the table's rim.
  ForwardMap::Interval elongations() const;
  /// The cells that are seen with this c_2 or inertia ratio; for StiffnessMeasure::deformation it does not count.
  std::shared_ptr<const ForwardMap> at(double elongation) const;

  /// The cell of such a map at (u, x), without pixels.
  struct Cell {
    ElongatedState state;
    double axial_ratio;
  };
  Cell cell(double elongation, double u, double x) const;
  /// Its features through pixels on average, in the recording's channel, with the errors of the outline.
  SolidFeatures seen(const Cell& cell) const;
  /// What these add to the pixels' errors.
  ShapeErrors outline_errors(const Cell& cell) const;

 private:
  class Sheets;
  StiffnessMeasure by_;
  std::unique_ptr<const Sheets> sheets_;
};

}  // namespace rheocyte
