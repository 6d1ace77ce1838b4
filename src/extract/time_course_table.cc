#include "extract/time_course_table.h"

#include <fmt/format.h>

#include <cmath>

#include "case/user_error.h"
#include "extract/event_table.h"
#include "infer/asymmetry_bias.h"
#include "numeric/quantile.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

constexpr std::string_view course_columns =
    "last_place_um\tradius_um\tyoung_modulus_kPa\tyoung_modulus_low_kPa\tyoung_modulus_high_kPa\tviscosity_Pas\t"
    "viscosity_low_Pas\tviscosity_high_Pas\tchi_squared\tstatus\tevent_numbers\n";
constexpr double flow_tolerance = 0.02;  // relative, between the recordings of one population

/// From the channel of the table to that of the recording.
struct Physical {
  double length, modulus, viscosity;
};

Physical physical(const DynamicTable& table, const ChannelFlow& flow) {
  const ChannelFlow simulated = channel_flow_of(table.spec().base);
  const ScaleFactors factors = scale_factors(simulated, flow);
  return {factors.length, factors.modulus, flow.viscosity_mPas / simulated.viscosity_mPas};
}

Credible times(const Credible& value, double factor) {
  return {value.value * factor, value.low * factor, value.high * factor};
}

std::string columns_of(const Credible& value) {
  return fmt::format("\t{:.5g}\t{:.5g}\t{:.5g}", value.value, value.low, value.high);
}

std::string with_interval(const Credible& value, std::string_view unit) {
  return fmt::format("{:.3g} {} (90 %: {:.3g} to {:.3g})", value.value, unit, value.low, value.high);
}

/// What a mechanical elongation does to the moduli, which the table's cells do not have; empty where there is none.
std::string elongation_text(const std::vector<CellImages>& cells) {
  constexpr double more_than_cells_of_the_model = 0.05;
  std::vector<double> mode_2;
  for (const CellImages& images : cells)
    for (const auto& image : images)
      if (std::isfinite(image.mode_2)) mode_2.push_back(image.mode_2);
  const double median = median_of(mode_2);
  if (!(median > more_than_cells_of_the_model)) return {};
  return fmt::format(
      "the cells are elongated along the flow (median c2 {:.2f}); if they are solids that are drawn out, Young's "
      "moduli "
      "are too high, by about {:.0f} % of themselves, see docs/real-cells.md",
      median, 100 * too_high_by_asymmetry(median));
}

std::string status_of(const CourseEstimate& estimate) {
  const bool modulus = estimate.young_modulus_kPa.is_resolved(), viscosity = estimate.viscosity_Pas.is_resolved();
  return modulus && viscosity ? "resolved" : modulus ? "viscosity unknown" : viscosity ? "modulus unknown" : "unknown";
}

}  // namespace

void CourseTable::add(const CourseEvents& events, const std::string& name, double contraction_um) {
  if (!rows_.empty()) {
    const ChannelFlow& first = rows_.front().flow;
    const auto differs = [](double one, double other) { return std::abs(one / other - 1) > flow_tolerance; };
    if (differs(events.flow.rate_ul_s, first.rate_ul_s) || differs(events.flow.viscosity_mPas, first.viscosity_mPas))
      throw UserError(
          fmt::format("{}: has {:.4g} ul/s and {:.4g} mPa s, the recordings before {:.4g} and {:.4g}; "
                      "recordings of one population must be of one flow, take them one by one.",
                      name, events.flow.rate_ul_s, events.flow.viscosity_mPas, first.rate_ul_s, first.viscosity_mPas));
  }
  CourseCells cells = course_cells(events, name, contraction_um, table_);
  for (CourseCell& cell : cells.cells) rows_.push_back({name, std::move(cell), events.flow});
  outside_places_ += cells.outside_places;
  outside_areas_ += cells.outside_areas;
  remarks_.push_back("recording: " + name);
  remarks_.push_back(fmt::format("end of the contraction: pos_x = {} um", contraction_um));
  remarks_.insert(remarks_.end(), events.settings.begin(), events.settings.end());
}

std::string CourseTable::line(const Row& row, std::size_t number) const {
  const CourseEstimate estimate = TimeCourse(table_).cell(row.cell.images);
  const Physical in = physical(table_, row.flow);
  std::string text = fmt::format("{}\t{}\t{}\t{:.4g}\t{:.4g}\t{:.4g}", row.recording, number, row.cell.images.size(),
                                 row.cell.images.front().place_um * in.length,
                                 row.cell.images.back().place_um * in.length, estimate.radius_um * in.length);
  text += columns_of(times(estimate.young_modulus_kPa, in.modulus)) +
          columns_of(times(estimate.viscosity_Pas, in.viscosity)) +
          fmt::format("\t{:.3g}\t{}\t", estimate.chi_squared, status_of(estimate));
  for (std::size_t i = 0; i < row.cell.events.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : " ", row.cell.events[i]);
  return text + "\n";
}

CourseReport CourseTable::report() const {
  std::vector<CourseCell> cells;
  std::vector<CellImages> images;
  for (const Row& row : rows_) {
    cells.push_back(row.cell);
    images.push_back(row.cell.images);
  }
  check_places_seen(cells);
  CourseReport report;
  report.text = std::string(mark_of_courses).append(course_columns);
  std::size_t seen_again = 0;
  for (const Row& row : rows_)
    if (seen_um(row.cell.images) >= min_seen_um) report.text += line(row, ++seen_again);
  std::vector<std::string> remarks{fmt::format("rheocyte {} time-course", version),
                                   fmt::format("dynamic table: {}", table_.spec().identifier)};
  remarks.insert(remarks.end(), remarks_.begin(), remarks_.end());
  report.lines.push_back(
      fmt::format("{} cells, {} of them seen over at least {:g} um; {} events at places and {} with "
                  "areas that the table does not have",
                  cells.size(), seen_again, min_seen_um, outside_places_, outside_areas_));
  if (const auto text = elongation_text(images); !text.empty()) report.lines.push_back(text);
  if (cells.size() >= min_population) {
    PopulationEstimate& population = report.population = TimeCourse(table_).population(images);
    const Physical in = physical(table_, rows_.front().flow);
    if (population.cells == 0)
      throw UserError(fmt::format(
          "rheocyte: no cell of the dynamic table {} can look like any of these; is it of this contraction?",
          table_.spec().identifier));
    population.young_modulus_kPa = times(population.young_modulus_kPa, in.modulus);
    population.viscosity_Pas = times(population.viscosity_Pas, in.viscosity);
    report.lines.push_back(
        fmt::format("population: Young's modulus {}, viscosity {}; spread by a factor of {:.2f} and "
                    "{:.2f}",
                    with_interval(population.young_modulus_kPa, "kPa"), with_interval(population.viscosity_Pas, "Pa s"),
                    std::exp(population.modulus_spread), std::exp(population.viscosity_spread)));
  }
  remarks.insert(remarks.end(), report.lines.begin(), report.lines.end());
  report.text += commented(remarks);
  return report;
}

}  // namespace rheocyte
