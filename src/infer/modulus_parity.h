// Young's modulus of each event from a published table, number for number as dclab gives it (docs/theory-extract.md,
// sec. "parity").
#pragma once
#include <span>

#include "infer/modulus_state.h"
#include "infer/published_table.h"
#include "infer/triangulation.h"

namespace rheocyte {

/// How the events were measured.
struct MeasuringConditions {
  double channel_width_um = 0;
  double flow_rate_ul_s = 0;
  double pixel_size_um = 0;  ///< 0: nothing is corrected for pixels
  bool correct_area = true;  ///< for pixels, with tables of rheocyte; those of others are made for areas as measured
};

/// What was measured, one value per event; viscosities may be a single value for all.
struct MeasuredEvents {
  std::span<const double> size;         ///< area (um^2), or volume (um^3) for a table of volumes
  std::span<const double> deformation;  ///< as measured
  std::span<const double> viscosity_mPas;
};

/// A published table, ready for events.
class ParityModulus {
 public:
  /// UserError if the table's points cannot be triangulated.
  explicit ParityModulus(PublishedTable table);

  const PublishedTable& table() const { return table_; }

  /// Young's moduli (kPa): the deformation less the pixels' part, size and modulus scaled to the table's channel, flow
  /// and viscosity, linear interpolation over the Delaunay triangulation of the points divided by their greatest size
  /// and deformation. NaN outside the points' convex hull. Spans of one length (asserted).
  void moduli(const MeasuringConditions& conditions, const MeasuredEvents& events, std::span<double> modulus_kPa) const;

  /// Why an event has the modulus that it has. `size` and `deformation` as measured.
  ModulusState state(const MeasuringConditions& conditions, double size, double deformation, double modulus_kPa) const;

 private:
  double size_scale(const MeasuringConditions& conditions) const;

  PublishedTable table_;
  double greatest_size_, greatest_deformation_;
  Triangulation triangulation_;
};

}  // namespace rheocyte
