// How well Young's modulus and viscosity of cells on their way come back from masks: round_trip_courses DIR
// [POPULATIONS [CELLS [PIXEL_UM [AXIAL_RATIO [SEED]]]]]
//
// The dynamic table in DIR shows virtual cells at four places; they are drawn into masks of pixels, whose contours give
// back single cells from all over the table, and populations of random medians. Times 3 viscosity / E of 0.1 to 5 ms.
// With an AXIAL_RATIO each cell is followed through the channel under a tension of up to this fraction of its modulus,
// which does not change along the channel: about half a second a cell.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "case/scales.h"
#include "infer/time_course.h"
#include "measurement/pixel_errors.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/quantile.h"
#include "program.h"
#include "sweep/follow_course.h"
#include "synth/course_shapes.h"
#include "synth/outline.h"

namespace {

using namespace rheocyte;

constexpr std::array places_um{15., 60., 140., 290.};
constexpr std::uint64_t seeds_apart = 1000;  // between the random numbers of one seed and the next
constexpr double modulus_spread = 0.15, viscosity_spread = 0.25, radius_spread = 0.04;
constexpr std::array times_ms{0.1, 0.3, 1., 3., 5.};

/// How often intervals hold the truth, and how far their middles are off.
struct Coverage {
  int held = 0, resolved = 0;
  std::vector<double> off, width;  // of the logarithm

  void take(const Credible& found, double truth) {
    held += found.low <= truth && truth <= found.high;
    resolved += found.is_resolved();
    off.push_back(std::log(found.value / truth));
    width.push_back(std::log(found.high / found.low));
  }
  void print(const std::string& what) const {
    if (off.empty()) return;
    const double percent = 100.0 / double(off.size());
    fmt::print("  {}: {:.1f} % of {} intervals hold it, {:.0f} % resolved; off by {:+.2f} % (median), {:.1f} % wide\n",
               what, percent * held, off.size(), percent * resolved, 100 * quantile(off, 0.5),
               100 * quantile(width, 0.5));
  }
};

struct Found {
  Coverage modulus, viscosity;
  void print(const std::string& what) const {
    modulus.print(what + ", E");
    viscosity.print(what + ", viscosity");
  }
};

class Laboratory {
 public:
  Laboratory(const DynamicTable& table, double pixel_um, double axial_ratio, std::uint64_t seed)
      : table_(table),
        flow_(channel_flow_of(table.spec().base)),
        shapes_(table, flow_),
        pixel_um_(pixel_um),
        axial_ratio_(axial_ratio),
        seed_(seed) {}

  /// Cells from all over the table.
  void look_at_cells(int cells) const {
    const TimeCourse course(table_);
    std::array<Found, times_ms.size() - 1> by_time;
    Found all;
    for (int i = 0; i < cells; ++i) {
      CellRandom random(seed_, std::uint64_t(i), Purpose::population);
      const DynamicCell cell = random_cell(random, 0, 0.1);
      const CellImages images = images_of(cell, random);
      if (images.empty()) continue;
      const CourseEstimate estimate = course.cell(images);
      std::size_t band = 0;
      while (cell.time_ms > times_ms[band + 1]) ++band;
      for (Found* found : {&all, &by_time[band]}) {
        found->modulus.take(estimate.young_modulus_kPa, cell.young_modulus_kPa);
        found->viscosity.take(estimate.viscosity_Pas, 1e-3 * cell.viscosity_mPas());
      }
    }
    fmt::print("cells\n");
    all.print("0.1 to 5 ms");
    for (std::size_t band = 0; band < by_time.size(); ++band)
      by_time[band].print(fmt::format("{} to {} ms", times_ms[band], times_ms[band + 1]));
  }

  /// One population; so far inside the table that hardly a cell lies outside.
  void look_at_population(std::uint64_t number, int cells) {
    CellRandom random(seeds_apart * seed_ + number, 0, Purpose::population);
    const DynamicCell median = random_cell(random, 3 * modulus_spread, 3 * radius_spread);
    std::vector<CellImages> seen;
    for (int i = 0; i < cells; ++i) {
      CellRandom own(seeds_apart * (seed_ + 1) + number, std::uint64_t(i), Purpose::population);
      DynamicCell cell = median;
      cell.radius_um *= 1 + radius_spread * own.normal();
      cell.young_modulus_kPa *= std::exp(modulus_spread * own.normal());
      const double viscosity_Pas = 1e-3 * median.viscosity_mPas() * std::exp(viscosity_spread * own.normal());
      cell.time_ms = 3 * viscosity_Pas / cell.young_modulus_kPa;
      if (auto images = images_of(cell, own); !images.empty()) seen.push_back(std::move(images));
    }
    const PopulationEstimate estimate = TimeCourse(table_).population(seen);
    populations_.modulus.take(estimate.young_modulus_kPa, median.young_modulus_kPa);
    populations_.viscosity.take(estimate.viscosity_Pas, 1e-3 * median.viscosity_mPas());
    fmt::print(
        "{:.2f} um {:.2f} kPa {:.3f} ms, {} cells: E {:+.2f} % ({:.2f} % wide), viscosity {:+.2f} % ({:.2f} %)\n",
        median.radius_um, median.young_modulus_kPa, median.time_ms, seen.size(), 100 * populations_.modulus.off.back(),
        100 * populations_.modulus.width.back(), 100 * populations_.viscosity.off.back(),
        100 * populations_.viscosity.width.back());
    std::fflush(stdout);
  }

  void report_populations() const { populations_.print("populations"); }

 private:
  /// With margins in ln(E) and in parts of the radius.
  DynamicCell random_cell(CellRandom& random, double of_modulus, double of_radius) const {
    const auto axes = nodes_of(table_.spec());
    const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    const double radius = between(axes[0].front() * (1 + of_radius), axes[0].back() * (1 - of_radius));
    const double modulus = between(axes[1].front() + of_modulus, axes[1].back() - of_modulus);
    return cell_at(table_.spec(), {radius, modulus, between(std::log(times_ms.front()), std::log(times_ms.back()))});
  }

  /// Empty if the table does not have the cell.
  CellImages images_of(const DynamicCell& cell, CellRandom& random) const {
    return axial_ratio_ > 0 ? images_under_tension(cell, axial_ratio_ * random.uniform(), random)
                            : images_by_table(cell, random);
  }

  /// Of the places of the table those that are nearest to the wanted ones.
  CellImages images_under_tension(const DynamicCell& cell, double axial_ratio, CellRandom& random) const {
    DynamicSpec spec = table_.spec();
    spec.base.flow.axial_tension_Pa = 1e3 * axial_ratio * cell.young_modulus_kPa;
    const CellCourse course = follow_course(spec, cell);
    if (course.status != Status::converged) return {};
    const std::vector<double> places = places_of(spec);
    CellImages images;
    for (const double wanted : places_um) {
      const auto nearest =
          std::ranges::min_element(places, {}, [&](double place) { return std::abs(place - wanted); }) - places.begin();
      const auto at = [&](CourseMeasure measure) { return course.value(nearest, int(measure)); };
      std::array<double, mode_count> modes{};
      for (int k = 0; k <= int(CourseMeasure::mode_7) - int(CourseMeasure::mode_2); ++k)
        modes[std::size_t(k)] = course.value(nearest, int(CourseMeasure::mode_2) + k);
      const double area = at(CourseMeasure::area_ratio) * std::numbers::pi * cell.radius_um * cell.radius_um;
      images.push_back(image_of(outline_of_modes(modes, area, outline_points), places[std::size_t(nearest)], random));
    }
    return images;
  }

  CourseImage image_of(const Eigen::MatrixX2d& outline, double place, CellRandom& random) const {
    const Eigen::RowVector2d place_px(random.uniform() - 0.5, random.uniform() - 0.5);
    const auto smooth = without_pixels(features_in_pixels(outline, pixel_um_, place_px), pixel_um_);
    return {place, smooth.area_um2, smooth.mode_3, smooth.deviation, smooth.mode_2};
  }

  CellImages images_by_table(const DynamicCell& cell, CellRandom& random) const {
    VirtualCell there;
    there.radius_um = cell.radius_um;
    there.stiffness = cell.young_modulus_kPa;
    there.viscosity_mPas = flow_.viscosity_mPas;
    there.own_viscosity_mPas = cell.viscosity_mPas();
    CellImages images;
    for (const double place : places_um) {
      there.place_um = place;
      const auto shape = shapes_.shape(there);
      const auto* const found = std::get_if<CellShape>(&shape);
      if (!found) return {};
      images.push_back(image_of(silhouette(found->meridian), place, random));
    }
    return images;
  }

  const DynamicTable& table_;
  ChannelFlow flow_;
  CourseShapes shapes_;
  double pixel_um_, axial_ratio_;
  std::uint64_t seed_;
  Found populations_;
};

}  // namespace

int rheocyte::measure(int argc, char** argv) {
  if (argc < 2) return fmt::print("round_trip_courses DIR [POPULATIONS [CELLS [PIXEL_UM [AXIAL_RATIO [SEED]]]]]\n"), 2;
  const DynamicTable table = read_dynamic_table(argv[1]);
  const int populations = argc > 2 ? std::atoi(argv[2]) : 20, cells = argc > 3 ? std::atoi(argv[3]) : 500;
  Laboratory laboratory(table, argc > 4 ? std::atof(argv[4]) : 0.34, argc > 5 ? std::atof(argv[5]) : 0,
                        argc > 6 ? std::strtoull(argv[6], nullptr, 10) : 1);
  laboratory.look_at_cells(cells);
  for (int i = 0; i < populations; ++i) laboratory.look_at_population(std::uint64_t(i), cells);
  if (populations > 0) laboratory.report_populations();
  return 0;
}
