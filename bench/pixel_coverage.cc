// How often the standard error of Young's modulus from area and deformation holds the truth, for cells of any model in
// pictures of many kinds: pixel_coverage GRID...
//
// The cells of each grid, of which the law of the pixels need not know, are drawn into masks of pixels at random
// places; their moduli are read off the same grid, so that nothing but the pixels is in between.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "grid_outlines.h"
#include "infer/grid_map.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/cell_random.h"
#include "numeric/quantile.h"
#include "program.h"

namespace {

using namespace rheocyte;

constexpr int cells = 4000;
constexpr double area_spread = 0.12, deformation_spread = 0.35;  // of the logarithms

/// A population in a channel: medians of area (parts of that of a disc as wide as the channel) and deformation.
struct Setting {
  double width_um, pixel_um, area, deformation;
};
constexpr std::array<Setting, 11> settings{{{20, 0.34, 0.18, 0.02},
                                            {20, 0.34, 0.25, 0.01},
                                            {20, 0.34, 0.35, 0.02},
                                            {20, 0.34, 0.35, 0.04},
                                            {20, 0.34, 0.55, 0.02},
                                            {20, 0.2, 0.3, 0.015},
                                            {20, 0.5, 0.4, 0.03},
                                            {15, 0.34, 0.35, 0.02},
                                            {30, 0.34, 0.3, 0.02},
                                            {30, 0.68, 0.3, 0.03},
                                            {40, 0.34, 0.25, 0.01}}};

struct Column {
  std::vector<double> area, deformation, viscosity;
  MeasuredEvents events() const { return {area, deformation, viscosity}; }
};

struct Found {
  std::vector<double> modulus, error;
};

Found moduli(const GridMap& map, const MeasuringConditions& conditions, const Column& cells_seen) {
  const std::size_t count = cells_seen.area.size();
  Found found{std::vector<double>(count), std::vector<double>(count)};
  std::vector<ModulusState> states(count);
  map.estimate(conditions, cells_seen.events(), {found.modulus, found.error, states});
  return found;
}

struct Coverage {
  double one = 0, ninety = 0, bias = 0, error = 0;
  std::size_t cells = 0;
};

Coverage look(const GridMap& map, const Setting& setting) {
  const TableOrigin& origin = map.origin();
  const ShapeGrid& shapes = map.shapes()->shapes();
  const double length = setting.width_um / origin.flow.width_um;
  const ChannelFlow flow{setting.width_um, origin.flow.rate_ul_s, 0, origin.flow.exponent};
  Column smooth, seen;
  for (int i = 0; i < cells; ++i) {
    CellRandom random(11, std::uint64_t(i), Purpose::population);
    const double disc = M_PI * std::pow(origin.flow.width_um / 2, 2);
    const double area = setting.area * disc * std::exp(area_spread * random.normal());
    const double d = setting.deformation * std::exp(deformation_spread * random.normal());
    const auto range = map.deformations(area);
    if (!(d > range.lower && d < range.upper)) continue;
    const Eigen::MatrixX2d outline = length * outline_in(shapes, area, d);
    const ShapeVector truth = shape_vector(outline_shape(outline));
    const Eigen::RowVector2d place(random.uniform() - 0.5, random.uniform() - 0.5);
    const ShapeVector measured = features_in_pixels(outline, setting.pixel_um, place);
    for (const auto& [column, shape] : {std::pair(&smooth, &truth), std::pair(&seen, &measured)}) {
      column->area.push_back(std::exp((*shape)(0)));
      column->deformation.push_back((*shape)(1));
      column->viscosity.push_back(origin.flow.viscosity_mPas);
    }
  }
  const Found truth = moduli(map, {flow, 0}, smooth), found = moduli(map, {flow, setting.pixel_um}, seen);
  Coverage coverage;
  std::vector<double> off, relative;
  for (std::size_t i = 0; i < truth.modulus.size(); ++i) {
    if (!std::isfinite(truth.modulus[i]) || !std::isfinite(found.modulus[i])) continue;
    const double difference = std::abs(found.modulus[i] - truth.modulus[i]);
    coverage.one += difference < found.error[i];
    coverage.ninety += difference < 1.6449 * found.error[i];
    off.push_back(found.modulus[i] / truth.modulus[i] - 1);
    relative.push_back(found.error[i] / found.modulus[i]);
  }
  coverage.cells = off.size();
  if (off.empty()) return coverage;
  coverage.one *= 100 / double(off.size());
  coverage.ninety *= 100 / double(off.size());
  coverage.bias = 100 * quantile(off, 0.5);
  coverage.error = 100 * quantile(relative, 0.5);
  return coverage;
}

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("pixel_coverage GRID...\n"), 2;
  for (int i = 1; i < argc; ++i) {
    const GridMap map(grid_in(argv[i]));
    fmt::print("{}\n", map.origin().identifier);
    for (const Setting& s : settings) {
      const Coverage c = look(map, s);
      fmt::print(
          "  {:2g} um, pixels {:.2f} um, {:4.0f} px, d {:.3f}: {:4} cells, bias {:+.2f} %, standard error {:4.1f} %, "
          "within it {:.1f} %, in the 90 % interval {:.1f} %\n",
          s.width_um, s.pixel_um, s.area * M_PI * std::pow(s.width_um / 2 / s.pixel_um, 2), s.deformation, c.cells,
          c.bias, c.error, c.one, c.ninety);
    }
  }
  return 0;
}
