#include "extract/course_events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "case/refuse_path.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "events/event_pass.h"
#include "events/event_reader.h"
#include "measurement/pixel_errors.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr std::size_t outlines_at_a_time = 256;
constexpr double same_width = 0.01;  // relative difference of the channels

const Recording& checked(const Recording& recording) {
  if (!recording.has_scalar("pos_x"))
    refuse_path(recording.file(),
                "has no pos_x, so the places of its cells along the channel are unknown; Young's modulus and viscosity "
                "follow from how they change from place to place.");
  return recording;
}

class CourseReader {
 public:
  CourseReader(const Recording& recording, const MeasuringOptions& options)
      : recording_(checked(recording)),
        events_(recording, options,
                {.outlines = OutlineUse::needed, .outlines_for = "the third mode of each outline is computed"}) {
    result_.has_time = recording.has_scalar("time");
  }

  void take(std::size_t first, std::size_t count) {
    events_.read(first, count);
    const auto viscosity = events_.viscosity_mPas();
    const auto x = scalar("pos_x", first, count), y = scalar("pos_y", first, count),
               time = scalar("time", first, count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!events_.is_inside(i) || !std::isfinite(x[i]) || !std::isfinite(viscosity[i])) continue;
      CourseEvent event{double(first + i + 1), x[i], y[i], time[i]};
      if (!measure(events_.shape(first + i), event)) {
        events_.count_cut(events_.is_cut(first + i));
        continue;
      }
      result_.events.push_back(event);
      viscosities_.push_back(viscosity[i]);
    }
  }

  CourseEvents result() {
    static_cast<RecordingFacts&>(result_) = events_.facts();
    if (result_.events.empty())
      refuse_path(recording_.file(), "has no event with an outline, a place and a viscosity.");
    result_.flow = events_.conditions().flow;
    result_.flow.viscosity_mPas = median_of(viscosities_);
    return std::move(result_);
  }

 private:
  std::vector<double> scalar(const char* name, std::size_t first, std::size_t count) const {
    std::vector<double> values(count, 0.0);
    if (recording_.has_scalar(name)) recording_.read_scalar(name, first, values);
    return values;
  }

  /// Without what the pixels do.
  bool measure(const ShapeVector& seen, CourseEvent& event) const {
    if (!seen.allFinite()) return false;
    const SmoothAsymmetry smooth = without_pixels(seen, events_.settings().pixel_size_um);
    event.area_um2 = smooth.area_um2;
    event.mode_2 = smooth.mode_2;
    event.mode_3 = smooth.mode_3;
    event.deviation = smooth.deviation;
    return true;
  }

  const Recording& recording_;
  EventReader events_;
  std::vector<double> viscosities_;
  CourseEvents result_;
};

/// An event in the channel of the table.
struct Placed {
  CourseEvent from;
  CourseImage image;
};

/// Links each picture to the next one of the same cell: it has come as far as the table's cell, and is as large.
class Linker {
 public:
  Linker(const DynamicTable& table, double unit_um, double unit_s)
      : table_(table), unit_um_(unit_um), unit_s_(unit_s) {}

  std::vector<CourseCell> link(std::vector<Placed> events, bool has_time) const {
    std::ranges::stable_sort(events, {}, [](const Placed& p) { return p.from.time_s; });
    std::vector<CourseCell> cells;
    std::vector<char> taken(events.size(), 0);
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (taken[i]) continue;
      CourseCell cell;
      for (std::size_t at = i; at < events.size();) {
        taken[at] = 1;
        cell.images.push_back(events[at].image);
        cell.events.push_back(events[at].from.event);
        at = has_time ? next_of(events, taken, at) : events.size();
      }
      cells.push_back(std::move(cell));
    }
    return cells;
  }

 private:
  static constexpr double tolerance_um = 3, tolerance_of_way = 0.1, tolerance_of_area = 0.08, sideways_um = 3;

  std::size_t next_of(const std::vector<Placed>& events, const std::vector<char>& taken, std::size_t at) const {
    const Placed& now = events[at];
    const double speed = speed_of(now.image), rest = table_.spec().last_um - now.image.place_um;  // table's um per s
    for (std::size_t i = at + 1; i < events.size(); ++i) {
      const Placed& then = events[i];
      const double way = speed * (then.from.time_s - now.from.time_s);
      if (way > rest * (1 + tolerance_of_way) + tolerance_um) break;
      const double gone = then.image.place_um - now.image.place_um;
      const bool is_there = std::abs(gone - way) < tolerance_um + tolerance_of_way * way && gone > tolerance_um;
      const bool is_alike = std::abs(then.image.area_um2 / now.image.area_um2 - 1) < tolerance_of_area &&
                            std::abs(then.from.y_um - now.from.y_um) < sideways_um;
      if (!taken[i] && is_there && is_alike) return i;
    }
    return events.size();
  }

  /// Of a cell of this area in the middle of the table.
  double speed_of(const CourseImage& image) const {
    const auto axes = nodes_of(table_.spec());
    const double radius = std::sqrt(image.area_um2 / std::numbers::pi);
    const double modulus = (axes[1].front() + axes[1].back()) / 2, time = (axes[2].front() + axes[2].back()) / 2;
    return table_.values(CourseMeasure::velocity, radius, image.place_um, {&modulus, 1}, {&time, 1})(0, 0) * unit_um_ /
           unit_s_;
  }

  const DynamicTable& table_;
  double unit_um_, unit_s_;  ///< the table's R in um, R/U of the recording
};

double median_place(const CourseEvents& events) {
  std::vector<double> places;
  for (const CourseEvent& event : events.events) places.push_back(event.x_um);
  return median_of(places);
}

void check_channel(const ChannelFlow& flow, const std::string& name, const DynamicTable& table) {
  const ChannelFlow simulated = channel_flow_of(table.spec().base);
  if (std::abs(flow.width_um / simulated.width_um - 1) <= same_width) return;
  throw UserError(fmt::format(
      "{}: its channel is {:.4g} um wide, and the dynamic table {} is for the contraction to one of {:.4g} um; give a "
      "table of its own contraction (`rheocyte help dynamic`).",
      name, flow.width_um, table.spec().identifier, simulated.width_um));
}

}  // namespace

CourseEvents read_course_events(const std::filesystem::path& path, const MeasuringOptions& options,
                                const TellProgress& report_progress) {
  Recording recording(path);
  EventPass pass(recording, report_progress);
  CourseReader reader(recording, options);
  pass.in_blocks(outlines_at_a_time, [&](std::size_t first, std::size_t count) { reader.take(first, count); });
  return reader.result();
}

CourseCells course_cells(const CourseEvents& events, const std::string& name, double contraction_um,
                         const DynamicTable& table, const SquareCourse* stationary) {
  check_channel(events.flow, name, table);
  const double direction = median_place(events) < contraction_um ? -1 : 1;
  const TimeCourse course(table);
  const ScaleFactors factors = scale_factors(channel_flow_of(table.spec().base), events.flow);
  CourseCells result;
  std::vector<Placed> placed;
  for (const CourseEvent& event : events.events) {
    const CourseImage image{direction * (event.x_um - contraction_um) / factors.length, event.area_um2 / factors.area,
                            direction * event.mode_3, event.deviation, event.mode_2};
    const bool has_place = table.has_place(image.place_um), has_area = course.has_area(image.area_um2);
    result.outside_places += !has_place;
    result.outside_areas += has_place && !has_area;
    if (has_place && has_area) placed.push_back({event, stationary ? stationary->in_table(image) : image});
  }
  const Case& base = table.spec().base;
  result.cells = Linker(table, unit_length_um(base), unit_time_s(base, factors.length, events.flow.rate_ul_s))
                     .link(std::move(placed), events.has_time);
  return result;
}

double seen_um(const CellImages& images) {
  const auto [first, last] = std::ranges::minmax(images, {}, &CourseImage::place_um);
  return last.place_um - first.place_um;
}

void check_places_seen(const std::vector<CourseCell>& cells) {
  constexpr const char* reason =
      "One picture does not distinguish a stiff cell from a viscous cell that is still deforming; the change of the "
      "third mode along the channel does.";
  std::vector<double> places;
  bool sees_a_cell_again = false;
  for (const CourseCell& cell : cells) {
    for (const CourseImage& image : cell.images) places.push_back(image.place_um);
    sees_a_cell_again = sees_a_cell_again || seen_um(cell.images) >= min_seen_um;
  }
  if (places.empty())
    throw UserError(
        "rheocyte: no event lies at a place, and has an area, that the dynamic table has; see "
        "dynamic.first_um, last_um, min_radius_um and max_radius_um in its spec.toml, and --contraction-um.");
  if (sees_a_cell_again) return;
  const double seen = central_width(places);
  if (seen < min_seen_um)
    throw UserError(
        fmt::format("rheocyte: all cells were seen at one place, within {:.3g} um: Young's modulus and "
                    "viscosity cannot be determined. {} Give recordings over at least {:g} um.",
                    seen, reason, min_seen_um));
  if (cells.size() < min_population)
    throw UserError(
        fmt::format("rheocyte: {} cells were seen once each: too few single images for Young's modulus and "
                    "viscosity. {} Give recordings that see a cell more than once, or at least {} cells.",
                    cells.size(), reason, min_population));
}

}  // namespace rheocyte
