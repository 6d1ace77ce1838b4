#include "infer/level_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "case/user_error.h"
#include "measurement/pixel_errors.h"
#include "measurement/pixelation.h"

namespace rheocyte {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int columns = 400;      // of the area, for a line from the smallest to the largest cell
constexpr int search_steps = 96;  // of the deformation, in which a crossing is looked for
constexpr int halvings = 40;      // of such a step
constexpr double rim = 0.02;  // of the table's height and width, where its triangles are long and thin: no lines there

std::vector<PlanePoint> normalised(const PublishedTable& table, double area, double deformation) {
  std::vector<PlanePoint> points(table.size.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {table.size[i] / area, table.deformation[i] / deformation};
  return points;
}

PublishedTable of_areas(PublishedTable table) {
  if (table.abscissa == Abscissa::area) return table;
  throw UserError(fmt::format("The table {} holds volumes; lines over the area need a table of areas.",
                              one_line(table.identifier, 100)));
}

}  // namespace

LineFinder::LineFinder(PublishedTable table)
    : table_(of_areas(std::move(table))),
      greatest_area_(std::ranges::max(table_.size)),
      greatest_deformation_(std::ranges::max(table_.deformation)),
      triangulation_(normalised(table_, greatest_area_, greatest_deformation_), table_.modulus_kPa) {}

double LineFinder::modulus_at(double x, double y) const {
  double modulus = nan;
  triangulation_.interpolate({&x, 1}, {&y, 1}, {&modulus, 1});
  return modulus;
}

std::vector<double> LineFinder::even_levels(int count) const {
  constexpr int steps = 2000;
  const double least = triangulation_.least_x();
  std::vector<double> along;
  for (int i = 0; i <= steps; ++i) {
    const double s = double(i) / steps, modulus = modulus_at(least + s * (1 - least), 1 - s);
    if (std::isfinite(modulus)) along.push_back(modulus);
  }
  std::vector<double> levels;
  for (int k = 0; k < count && !along.empty(); ++k) {
    const double share = (k + 0.3) / count;  // the published lines, too, begin nearer to the soft rim
    levels.push_back(along[static_cast<std::size_t>(share * static_cast<double>(along.size()))]);
  }
  return levels;
}

// Moduli fall with the deformation, but at the rim of some tables not everywhere: of several crossings the one next to
// the line's last point counts. Steps are finer at small deformations, where moduli fall steeply.
double LineFinder::deformation_at(double x, double modulus_kPa, double near) const {
  const auto border = triangulation_.border_at(x);
  const auto place = [&](double t) { return border.lower + (border.upper - border.lower) * t * t; };
  double found = nan, before = modulus_at(x, place(0));
  for (int k = 1; k <= search_steps; ++k) {
    const double after = modulus_at(x, place(double(k) / search_steps));
    if ((before - modulus_kPa) * (after - modulus_kPa) <= 0) {  // false for NaN
      double low = place((k - 1.0) / search_steps), high = place(double(k) / search_steps);
      for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        ((modulus_at(x, middle) - modulus_kPa) * (before - modulus_kPa) > 0 ? low : high) = middle;
      }
      if (!(std::abs(found - near) <= std::abs(low - near))) found = low;
    }
    before = after;
  }
  return found;
}

// From large cells, where lines lie apart, to small ones.
LevelLine LineFinder::line(double modulus_kPa) const {
  LevelLine result{modulus_kPa, {}};
  const double first = triangulation_.least_x(), last = triangulation_.greatest_x();
  double near = nan;
  for (int i = columns - 1 - static_cast<int>(rim * columns); i > rim * columns; --i) {
    const double x = first + (last - first) * i / (columns - 1), y = deformation_at(x, modulus_kPa, near);
    if (y < (1 - rim) * triangulation_.border_at(x).upper) {  // false for NaN
      result.points.push_back({x * greatest_area_, y * greatest_deformation_});
      near = y;
    } else if (!result.points.empty()) {
      break;
    }
  }
  std::ranges::reverse(result.points);
  return result;
}

LevelLines LineFinder::lines(std::span<const double> levels_kPa) const {
  LevelLines result{table_.identifier, table_.channel_width_um, table_.flow_rate_ul_s, table_.viscosity_mPas, {}};
  for (const double level : levels_kPa) {
    LevelLine one = line(level);
    if (one.points.size() > 1) result.lines.push_back(std::move(one));
  }
  std::ranges::sort(result.lines, {}, &LevelLine::modulus_kPa);
  return result;
}

std::vector<PlanePoint> LineFinder::support() const {
  std::vector<PlanePoint> lower, upper;
  const double first = triangulation_.least_x(), last = triangulation_.greatest_x();
  for (int i = 0; i < columns; ++i) {
    const double x = i + 1 < columns ? first + (last - first) * i / (columns - 1) : last;
    const auto border = triangulation_.border_at(x);
    lower.push_back({x * greatest_area_, border.lower * greatest_deformation_});
    upper.push_back({x * greatest_area_, border.upper * greatest_deformation_});
  }
  lower.insert(lower.end(), upper.rbegin(), upper.rend());
  return lower;
}

LevelLines read_level_lines(const std::filesystem::path& file) {
  const PublishedTable rows = of_areas(read_published_table(file, lines_identifier_key));
  LevelLines result{rows.identifier, rows.channel_width_um, rows.flow_rate_ul_s, rows.viscosity_mPas, {}};
  std::map<double, std::vector<PlanePoint>> by_modulus;
  for (std::size_t i = 0; i < rows.size.size(); ++i)
    by_modulus[rows.modulus_kPa[i]].push_back({rows.size[i], rows.deformation[i]});
  for (auto& [modulus, points] : by_modulus) result.lines.push_back({modulus, std::move(points)});
  constexpr std::size_t greatest_number = 200;
  if (result.lines.size() > greatest_number)
    throw UserError(
        fmt::format("{}: holds {} different moduli; it is a look-up table, not a file of lines: give it "
                    "with --table.",
                    one_line(file.string(), 300), result.lines.size()));
  return result;
}

double modulus_factor(const LevelLines& made_at, const MeasuringConditions& conditions, double viscosity_mPas) {
  const double ratio = made_at.channel_width_um / conditions.channel_width_um;
  return conditions.flow_rate_ul_s / made_at.flow_rate_ul_s * viscosity_mPas / made_at.viscosity_mPas * ratio * ratio *
         ratio;
}

std::vector<PlanePoint> as_measured(std::span<const PlanePoint> points, double made_in_width_um,
                                    const MeasuringConditions& conditions, PixelCorrection law) {
  const double ratio = conditions.channel_width_um / made_in_width_um;
  std::vector<PlanePoint> result;
  result.reserve(points.size());
  for (const auto& point : points) {
    const double area = point.x * ratio * ratio, pixel_area = conditions.pixel_size_um * conditions.pixel_size_um;
    if (law == PixelCorrection::own && pixel_area > 0) {
      const auto seen = seen_through_pixels({area / pixel_area, point.y});
      result.push_back({seen.area_px * pixel_area, seen.deformation});
      continue;
    }
    const double excess =
        conditions.pixel_size_um > 0 ? deformation_by_pixels_at_area(area, conditions.pixel_size_um) : 0;
    result.push_back({area, point.y + excess});
  }
  return result;
}

}  // namespace rheocyte
