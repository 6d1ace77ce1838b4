// Isoelasticity lines, of equal Young's modulus over area and deformation, and the region in which a table has moduli
// (docs/plot-and-synth.md, sec. "lines").
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "infer/modulus_map.h"

namespace rheocyte {

/// Points (area in um^2, deformation) of one modulus, by growing area.
struct IsoelasticityLine {
  double modulus_kPa = 0;
  std::vector<PlanePoint> points;
};

struct IsoelasticityLines {
  std::string identifier;                ///< of the table
  ChannelFlow flow;                      ///< for which they hold
  std::vector<IsoelasticityLine> lines;  ///< by growing modulus
};

/// Moduli (kPa) of `count` lines that cut the diagonal of the picture, from small soft cells to large stiff ones, at
/// equal distances: close to the levels of the published lines.
std::vector<double> even_levels(const ModulusMap& map, int count);

/// The lines of these moduli at the table's own conditions, at equal steps of the area. A modulus that the table does
/// not have gives no line.
IsoelasticityLines isoelasticity_lines(const ModulusMap& map, std::span<const double> levels_kPa);

/// The border of the region in which the table has moduli, a closed polygon.
std::vector<PlanePoint> support(const ModulusMap& map);

/// The same points in a picture of a measurement: areas scaled to its channel, and what the pixels do added as the map
/// takes it away, unless the pixel size is 0. Without a map by the law of the field's programs.
std::vector<PlanePoint> as_measured(std::span<const PlanePoint> points, const ChannelFlow& made_at,
                                    const MeasuringConditions& conditions, const ModulusMap* map);

/// Reads lines in dclab's format: three columns, rows of one modulus together make a line. UserError with file and
/// line.
IsoelasticityLines read_isoelasticity_lines(const std::filesystem::path& file);

}  // namespace rheocyte
