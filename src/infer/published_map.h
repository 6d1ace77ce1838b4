// Published look-up tables, and Young's modulus of each event from one of them, number for number as dclab gives it
// (docs/theory-extract.md, sec. "parity").
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "infer/modulus_map.h"
#include "infer/triangulation.h"
#include "table/table_text.h"

namespace rheocyte {

/// A table for one channel, flow rate and viscosity; other conditions follow from it by scaling.
struct PublishedTable {
  std::string identifier;  ///< e.g. "LE-2D-FEM-19"
  ChannelFlow flow;
  Abscissa abscissa = Abscissa::area;
  /// Equally long: area (um^2) or volume (um^3) of a cell, its deformation, its Young's modulus (kPa).
  std::vector<double> size = {}, deformation = {}, modulus_kPa = {};
};

/// Reads a table in the format of dclab, or lines with their key. UserError with file and line as read_table_text; also
/// for a missing name, fewer than three rows, no positive deformation.
PublishedTable read_published_table(const std::filesystem::path& file,
                                    const char* identifier_key = table_identifier_key);

/// The identifier that the metadata in the head of such a file give, without reading its numbers; empty if it has none.
std::string published_identifier(const std::filesystem::path& file);

/// Where a cell lies in a picture with such pixels by the law of the field's programs, which leaves areas alone.
PlanePoint with_pixelation(const PlanePoint& cell, double pixel_size_um);

/// UserError if the table does not hold areas.
void refuse_volumes(const PublishedTable& table);

/// Linear interpolation over the Delaunay triangulation of the points, divided by their greatest size and deformation;
/// NaN outside their convex hull.
class PublishedMap : public ModulusMap {
 public:
  /// UserError if the table's points cannot be triangulated. Of a table of volumes only events have moduli.
  explicit PublishedMap(PublishedTable table);

  bool is_rheocyte_table() const override { return false; }
  /// A single viscosity may stand for all events.
  void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                const EstimatedModuli& moduli) const override;
  /// Of which these are the moduli, and the state of one event with its modulus.
  void moduli(const MeasuringConditions& conditions, const MeasuredEvents& events, std::span<double> modulus_kPa) const;
  ModulusState state(const MeasuringConditions& conditions, double size, double deformation, double modulus_kPa) const;

  Interval areas() const override;
  Interval deformations(double area_um2) const override;
  double modulus_kPa(double area_um2, double deformation) const override;
  double rim() const override { return 0.02; }  ///< its triangles are long and thin there
  PlanePoint seen_through_pixels(const PlanePoint& cell, double pixel_size_um) const override;

 private:
  double size_scale(const MeasuringConditions& conditions) const;
  void correct(double pixel_size_um, std::span<const double> size, std::span<const double> measured,
               std::span<double> corrected) const;

  Abscissa abscissa_;
  double max_size_, max_deformation_;
  Triangulation triangulation_;
};

}  // namespace rheocyte
