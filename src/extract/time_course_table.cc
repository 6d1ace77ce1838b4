#include "extract/time_course_table.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <span>

#include "case/user_error.h"
#include "extract/event_table.h"
#include "numeric/quantile.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

constexpr std::string_view course_columns =
    "last_place_um\tradius_um\tyoung_modulus_kPa\tyoung_modulus_low_kPa\tyoung_modulus_high_kPa\tviscosity_Pas\t"
    "viscosity_low_Pas\tviscosity_high_Pas\tchi_squared\tsection_factor\tsection_error\tstatus\tevent_numbers\n";
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

/// By how much c_3 is greater than in the tube, on average over pictures.
double section_factor_of(std::span<const CellImages> cells) {
  double sum = 0, count = 0;
  for (const CellImages& images : cells)
    for (const CourseImage& image : images) sum += std::log(image.section_factor), ++count;
  return std::exp(sum / count);
}

/// Standard deviations of ln(E) and ln(viscosity) by what is left of the correction for the square channel.
struct SectionErrors {
  double modulus = 0, viscosity = 0;
};

SectionErrors section_errors(double factor, double unsettled) {
  if (factor == 1) return {};
  const double modulus = std::hypot(error_left_by_section(factor), unsettled);
  return {modulus, std::hypot(modulus, error_of_speed_by_section)};
}

/// The same value with an interval that holds this error, too.
Credible widened(const Credible& value, double error) {
  const auto end = [&](double old, double sign) {
    return value.value * std::exp(sign * std::hypot(std::log(old / value.value), normal_quantile_of_credible * error));
  };
  return {value.value, end(value.low, -1), end(value.high, 1)};
}

std::string columns_of(const Credible& value) {
  return fmt::format("\t{:.5g}\t{:.5g}\t{:.5g}", value.value, value.low, value.high);
}

std::string with_interval(const Credible& value, std::string_view unit) {
  return fmt::format("{:.3g} {} (90 %: {:.3g} to {:.3g})", value.value, unit, value.low, value.high);
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
  std::optional<SquareCourse> to_tube;
  if (const ModulusMap* const square = square_.table(events.flow.exponent)) {
    to_tube.emplace(table_, *square);
    square_table_ = square->origin().identifier;
    unsettled_ = to_tube->unsettled();
  }
  CourseCells cells = course_cells(events, name, contraction_um, table_, to_tube ? &*to_tube : nullptr);
  for (CourseCell& cell : cells.cells) rows_.push_back({name, std::move(cell), events.flow});
  outside_places_ += cells.outside_places;
  outside_areas_ += cells.outside_areas;
  remarks_.push_back("recording: " + name);
  remarks_.push_back(fmt::format("end of the contraction: pos_x = {} um", contraction_um));
  remarks_.insert(remarks_.end(), events.settings.begin(), events.settings.end());
}

std::string CourseTable::line(const Row& row, std::size_t number) const {
  CourseEstimate estimate = TimeCourse(table_).cell(row.cell.images);
  const double factor = section_factor_of({&row.cell.images, 1});
  const SectionErrors errors = section_errors(factor, unsettled_);
  estimate.young_modulus_kPa = widened(estimate.young_modulus_kPa, errors.modulus);
  estimate.viscosity_Pas = widened(estimate.viscosity_Pas, errors.viscosity);
  const Physical in = physical(table_, row.flow);
  std::string text = fmt::format("{}\t{}\t{}\t{:.4g}\t{:.4g}\t{:.4g}", row.recording, number, row.cell.images.size(),
                                 row.cell.images.front().place_um * in.length,
                                 row.cell.images.back().place_um * in.length, estimate.radius_um * in.length);
  text +=
      columns_of(times(estimate.young_modulus_kPa, in.modulus)) +
      columns_of(times(estimate.viscosity_Pas, in.viscosity)) +
      fmt::format("\t{:.3g}\t{:.4g}\t{:.2g}\t{}\t", estimate.chi_squared, factor, errors.modulus, status_of(estimate));
  for (std::size_t i = 0; i < row.cell.events.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : " ", row.cell.events[i]);
  return text + "\n";
}

std::string CourseTable::section_text(const std::vector<CellImages>& cells) const {
  if (square_table_.empty()) return std::string(no_square_text);
  const double factor = section_factor_of(cells);
  const SectionErrors errors = section_errors(factor, unsettled_);
  return fmt::format(
      "the channel is square, and the table one of the tube of equal pressure drop: c3 was divided by {:.3f} (mean), "
      "as "
      "{} says of stationary solids; what may be left, {:.1f} % of E and {:.1f} % of the viscosity, is in the "
      "intervals",
      factor, square_table_, 100 * errors.modulus, 100 * errors.viscosity);
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
  if (section_ == Section::square) report.lines.push_back(section_text(images));
  if (cells.size() >= min_population) {
    PopulationEstimate& population = report.population = TimeCourse(table_).population(images);
    const SectionErrors errors = section_errors(section_factor_of(images), unsettled_);
    population.young_modulus_kPa = widened(population.young_modulus_kPa, errors.modulus);
    population.viscosity_Pas = widened(population.viscosity_Pas, errors.viscosity);
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
