// Lines of equal Young's modulus and the region of support of a published table (docs/plot-and-synth.md, sec. "lines").
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "infer/modulus_parity.h"
#include "infer/published_table.h"
#include "infer/triangulation.h"

namespace rheocyte {

/// Points (area in um^2, deformation) of one modulus, by growing area.
struct LevelLine {
  double modulus_kPa = 0;
  std::vector<PlanePoint> points;
};

/// Lines for one channel width, flow rate and viscosity.
struct LevelLines {
  std::string identifier;  ///< of the table
  double channel_width_um = 0, flow_rate_ul_s = 0, viscosity_mPas = 0;
  std::vector<LevelLine> lines;  ///< by growing modulus
};

/// A table of areas, ready for lines.
class LineFinder {
 public:
  /// UserError if the table holds volumes or cannot be triangulated.
  explicit LineFinder(PublishedTable table);

  const PublishedTable& table() const { return table_; }

  /// Moduli (kPa) of `count` lines that cut the diagonal of the picture, from small soft cells to large stiff ones, at
  /// equal distances: close to the levels of the published lines.
  std::vector<double> even_levels(int count) const;

  /// The lines of these moduli at the table's own conditions: where linear interpolation between its points has the
  /// modulus, at equal steps of the area. They end a little before the rim of the support, where there is nothing
  /// to interpolate between. A modulus that the table does not have gives no line.
  LevelLines lines(std::span<const double> levels_kPa) const;

  /// The border of the region in which the table has moduli, a closed polygon.
  std::vector<PlanePoint> support() const;

 private:
  double modulus_at(double x, double y) const;
  double deformation_at(double x, double modulus_kPa, double near) const;
  LevelLine line(double modulus_kPa) const;

  PublishedTable table_;
  double greatest_area_ = 0, greatest_deformation_ = 0;
  Triangulation triangulation_;
};

/// Reads lines in dclab's format: three columns, rows of one modulus together make a line. UserError with file and
/// line.
LevelLines read_level_lines(const std::filesystem::path& file);

/// Young's modulus (kPa) at `viscosity_mPas` and the conditions of a measurement for one kPa of lines or a table made
/// at (width um, flow ul/s, viscosity mPa s) (eq:scaling).
double modulus_factor(const LevelLines& made_at, const MeasuringConditions& conditions, double viscosity_mPas);

/// By which law pixels are taken into account: that of the field's programs, which leaves areas alone, or our own.
enum class PixelCorrection { field, own };

/// The same points in a picture of a measurement: areas scaled to its channel, and what the pixels do added, unless the
/// pixel size is 0.
std::vector<PlanePoint> as_measured(std::span<const PlanePoint> points, double made_in_width_um,
                                    const MeasuringConditions& conditions,
                                    PixelCorrection law = PixelCorrection::field);

}  // namespace rheocyte
