#include "infer/isoelasticity_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "case/refuse_path.h"
#include "infer/published_map.h"
#include "numeric/no_value.h"
#include "numeric/roots.h"

namespace rheocyte {

namespace {

constexpr int column_count = 400;  // of the area, for a line from the smallest to the largest cell
constexpr int search_steps = 96;   // of the deformation, in which a crossing is looked for

double area_at(const ModulusMap& map, int column) {
  const auto [lower, upper] = map.areas();
  return column + 1 < column_count ? lower + (upper - lower) * column / (column_count - 1) : upper;
}

/// The moduli of one area, at steps that are finer at small deformations, where moduli fall steeply.
class Column {
 public:
  Column(const ModulusMap& map, double area) : map_(map), area_(area), range_(map.deformations(area)) {
    for (int k = 0; k <= search_steps; ++k) moduli_.push_back(map.modulus_kPa(area, place(k)));
  }

  double area() const { return area_; }
  double upper() const { return range_.upper; }

  /// Moduli fall with the deformation, but at the rim of some tables not everywhere: of several crossings the one next
  /// to the line's last point counts. NaN without any.
  double deformation_at(double modulus_kPa, double near) const {
    double found = no_value;
    for (int k = 1; k <= search_steps; ++k) {
      const double before = moduli_[std::size_t(k) - 1], after = moduli_[std::size_t(k)];
      if (!((before - modulus_kPa) * (after - modulus_kPa) <= 0)) continue;  // also for NaN
      const auto excess = [&](double deformation) { return map_.modulus_kPa(area_, deformation) - modulus_kPa; };
      const double root = bracketed_root(excess, place(k - 1), place(k));
      if (!(std::abs(found - near) <= std::abs(root - near))) found = root;
    }
    return found;
  }

 private:
  double place(int step) const {
    const double t = double(step) / search_steps;
    return range_.lower + (range_.upper - range_.lower) * t * t;
  }

  const ModulusMap& map_;
  double area_;
  ModulusMap::Interval range_;
  std::vector<double> moduli_;
};

// From large cells, where lines lie apart, to small ones; up to the first gap.
IsoelasticityLine line_through(std::span<const Column> columns, double modulus_kPa, double rim) {
  IsoelasticityLine line{modulus_kPa, {}};
  double near = no_value;
  for (const Column& column : columns) {
    const double deformation = column.deformation_at(modulus_kPa, near);
    if (deformation <= (1 - rim) * column.upper()) {  // false for NaN
      line.points.push_back({column.area(), deformation});
      near = deformation;
    } else if (!line.points.empty()) {
      break;
    }
  }
  std::ranges::reverse(line.points);
  return line;
}

}  // namespace

std::vector<double> even_levels(const ModulusMap& map, int count) {
  constexpr int steps = 2000;
  double highest = 0;
  for (int i = 0; i < column_count; ++i) highest = std::max(highest, map.deformations(area_at(map, i)).upper);
  const auto [least, greatest] = map.areas();
  std::vector<double> along;
  for (int i = 0; i <= steps; ++i) {
    const double s = double(i) / steps, modulus = map.modulus_kPa(least + s * (greatest - least), (1 - s) * highest);
    if (std::isfinite(modulus)) along.push_back(modulus);
  }
  std::vector<double> levels;
  for (int k = 0; k < count && !along.empty(); ++k) {
    const double fraction = (k + 0.3) / count;  // the published lines, too, begin nearer to the soft rim
    levels.push_back(along[static_cast<std::size_t>(fraction * static_cast<double>(along.size()))]);
  }
  return levels;
}

IsoelasticityLines isoelasticity_lines(const ModulusMap& map, std::span<const double> levels_kPa) {
  const int skipped = static_cast<int>(std::ceil(map.rim() * column_count));
  std::vector<Column> columns;
  for (int i = column_count - 1 - skipped; i >= skipped; --i) columns.emplace_back(map, area_at(map, i));
  IsoelasticityLines result{map.origin().identifier, map.origin().flow, {}};
  for (const double level : levels_kPa) {
    IsoelasticityLine line = line_through(columns, level, map.rim());
    if (line.points.size() > 1) result.lines.push_back(std::move(line));
  }
  std::ranges::sort(result.lines, {}, &IsoelasticityLine::modulus_kPa);
  return result;
}

std::vector<PlanePoint> support(const ModulusMap& map) {
  std::vector<PlanePoint> border, upper;
  for (int i = 0; i < column_count; ++i) {
    const double area = area_at(map, i);
    const auto range = map.deformations(area);
    border.push_back({area, range.lower});
    upper.push_back({area, range.upper});
  }
  border.insert(border.end(), upper.rbegin(), upper.rend());
  return border;
}

std::vector<PlanePoint> as_measured(std::span<const PlanePoint> points, const ChannelFlow& made_at,
                                    const MeasuringConditions& conditions, const ModulusMap* map) {
  const double scale = scale_factors(made_at, conditions.flow).area, pixel_um = conditions.pixel_size_um;
  std::vector<PlanePoint> result;
  for (const auto& point : points) {
    const PlanePoint cell{point.x * scale, point.y};
    result.push_back(pixel_um == 0 ? cell
                     : map         ? map->seen_through_pixels(cell, pixel_um)
                                   : with_pixelation(cell, pixel_um));
  }
  return result;
}

IsoelasticityLines read_isoelasticity_lines(const std::filesystem::path& file) {
  const PublishedTable rows = read_published_table(file, lines_identifier_key);
  refuse_volumes(rows);
  std::map<double, std::vector<PlanePoint>> by_modulus;
  for (std::size_t i = 0; i < rows.size.size(); ++i)
    by_modulus[rows.modulus_kPa[i]].push_back({rows.size[i], rows.deformation[i]});
  constexpr std::size_t max_number = 200;
  if (by_modulus.size() > max_number)
    refuse_path(
        file,
        fmt::format("contains {} different moduli; it is a look-up table, not a file of lines: give it with --table.",
                    by_modulus.size()));
  IsoelasticityLines result{rows.identifier, rows.flow, {}};
  for (auto& [modulus, points] : by_modulus) result.lines.push_back({modulus, std::move(points)});
  return result;
}

}  // namespace rheocyte
