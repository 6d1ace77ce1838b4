// Young's modulus over area and deformation, as a table of solids knows it: one interface for all kinds of tables.
#pragma once
#include <span>
#include <utility>

#include "infer/modulus_state.h"
#include "infer/triangulation.h"
#include "numeric/no_value.h"
#include "table/table_origin.h"

namespace rheocyte {

/// How events were measured.
struct MeasuringConditions {
  ChannelFlow flow;          ///< its viscosity is that of all events, if they have one in common
  double pixel_size_um = 0;  ///< 0: nothing is corrected for pixels
  bool correct_area = true;  ///< for pixels, with tables of rheocyte; those of others are made for areas as measured
};

/// What was measured, one value per event, spans of one length.
struct MeasuredEvents {
  std::span<const double> size;         ///< area (um^2), or volume (um^3) for a table of volumes
  std::span<const double> deformation;  ///< as measured
  std::span<const double> viscosity_mPas;
};

/// One value per event, spans of one length.
struct EstimatedModuli {
  std::span<double> modulus_kPa;         ///< NaN without a modulus
  std::span<double> standard_error_kPa;  ///< of pixels and of the table; NaN where the table does not know its error
  std::span<ModulusState> state;
};

class ShapeMap;
struct GridAnswer;

/// What is said about an event with this answer of a grid.
ModulusState state_of(const GridAnswer& answer);

class ModulusMap {
 public:
  virtual ~ModulusMap() = default;

  const TableOrigin& origin() const { return origin_; }
  /// Whether it is one of rheocyte's own grids: for these areas are corrected for pixels, too, and errors are known.
  /// Published tables are used as the programs of the field do.
  virtual bool is_rheocyte_table() const = 0;
  /// What its cells look like; null if it does not know.
  virtual const ShapeMap* shapes() const { return nullptr; }

  /// Area and deformation less what the pixels do (unless the pixel size is 0), area and modulus scaled to the table's
  /// channel, flow and viscosity (docs/theory-extract.md, eq:scaling).
  virtual void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                        const EstimatedModuli& moduli) const = 0;

  /// In the channel of the table and without pixels, as isoelasticity lines need it: the region with moduli, by area
  /// (um^2), and the modulus (kPa) there, NaN outside.
  struct Interval {
    double lower = no_value, upper = lower;
  };
  virtual Interval areas() const = 0;
  virtual Interval deformations(double area_um2) const = 0;
  virtual double modulus_kPa(double area_um2, double deformation) const = 0;
  /// Fraction of the region's width and height at the rim, where lines would only follow the noise of the table.
  virtual double rim() const { return 0; }
  /// Where a cell of this area and deformation lies in a picture with such pixels.
  virtual PlanePoint seen_through_pixels(const PlanePoint& cell, double pixel_size_um) const = 0;

 protected:
  explicit ModulusMap(TableOrigin origin) : origin_(std::move(origin)) {}
  /// Young's modulus in a measurement for one in the channel of the table, divided by the viscosity in the measurement.
  double factor_per_mPas(const MeasuringConditions& conditions) const {
    return scale_factors(origin_.flow, {conditions.flow.width_um, conditions.flow.rate_ul_s, 1}).modulus;
  }

 private:
  TableOrigin origin_;
};

}  // namespace rheocyte
