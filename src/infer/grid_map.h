// Young's modulus of each event with its standard error, from a grid of rheocyte's own tables (docs/theory-extract.md,
// sec. "own tables").
#pragma once
#include <memory>

#include "infer/modulus_map.h"
#include "infer/shape_map.h"
#include "infer/smooth_events.h"
#include "table/stiffness_grid.h"

namespace rheocyte {

class GridMap : public ModulusMap {
 public:
  /// UserError if the grid's stiffness is not Young's modulus.
  explicit GridMap(GridContent grid);

  bool is_rheocyte_table() const override { return true; }
  const ShapeMap* shapes() const override { return shapes_.get(); }
  /// The standard error comes from the scatter by pixels and the table's error (eq:standard-error).
  void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                const EstimatedModuli& moduli) const override;
  /// Of at most so many events (asserted), event_block_size or few_events, from which `remove_pixels` has removed the
  /// pixels: several tables need that once. Scales their areas to the channel of the table.
  template <std::size_t most>
  void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events, SmoothEventsOf<most>& smooth,
                const EstimatedModuli& moduli) const;

  /// Where the bare surface is smooth.
  Interval areas() const override;
  Interval deformations(double area_um2) const override;
  double modulus_kPa(double area_um2, double deformation) const override;
  PlanePoint seen_through_pixels(const PlanePoint& cell, double pixel_size_um) const override;

 private:
  StiffnessGrid grid_;
  std::unique_ptr<const ShapeMap> shapes_;
};

}  // namespace rheocyte
