#include "report/time_course_table.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <span>

#include "case/user_error.h"
#include "extract/shape_verdict.h"
#include "numeric/quantile.h"
#include "report/event_table.h"
#include "report/rows_text.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

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

std::string with_interval(const Credible& value, std::string_view unit) {
  return fmt::format("{:.3g} {} (90 %: {:.3g} to {:.3g})", value.value, unit, value.low, value.high);
}

constexpr std::string_view no_thinning_text =
    "the liquid is not shear-thinning as that of the table, and no table of it has the solids of this one: the "
    "viscosity at the wall stands for both, and moduli are off by up to 5 %, those of large cells most.";

std::string status_of(const CourseEstimate& estimate) {
  const bool modulus = estimate.young_modulus_kPa.is_resolved(), viscosity = estimate.viscosity_Pas.is_resolved();
  return modulus && viscosity ? "resolved" : modulus ? "viscosity unknown" : viscosity ? "modulus unknown" : "unknown";
}

}  // namespace

CourseTable::CourseTable(const DynamicTable& table, std::optional<Section> section)
    : table_(table), section_(section), square_(section.value_or(Section::square), table.spec().base) {
  if (section == Section::tube && is_of_square())
    throw UserError(
        fmt::format("rheocyte: --section tube, but the dynamic table {} is one of the square channel; leave the option "
                    "out, or give a table of a tube.",
                    table.spec().identifier));
}

bool CourseTable::is_of_square() const { return table_.spec().base.channel.section == Section::square; }

bool CourseTable::is_elsewhere(const CourseEvents& events) const {
  const Case& base = table_.spec().base;
  if (!section_ && are_cells_of(base, events.made_of)) return false;
  if (!is_of_square()) return section_ != Section::tube;
  return std::abs(events.flow.exponent - channel_flow_of(base).exponent) > flow_exponent_tolerance;
}

void CourseTable::add(const CourseEvents& events, const std::string& name, double contraction_um) {
  if (!rows_.empty()) {
    const ChannelFlow& first = rows_.front().flow;
    const auto differs = [](double one, double other) { return std::abs(one / other - 1) > flow_tolerance; };
    if (differs(events.flow.rate_ul_s, first.rate_ul_s) || differs(events.flow.viscosity_mPas, first.viscosity_mPas))
      throw UserError(
          fmt::format("{}: has {:.4g} ul/s and {:.4g} mPa s, the recordings before {:.4g} and {:.4g}; recordings of "
                      "one population must have the same flow rate and viscosity. Analyse these one by one.",
                      name, events.flow.rate_ul_s, events.flow.viscosity_mPas, first.rate_ul_s, first.viscosity_mPas));
  }
  std::optional<SquareCourse> stationary;
  const bool is_elsewhere = this->is_elsewhere(events);
  are_elsewhere_ = are_elsewhere_ || is_elsewhere;
  if (!section_ && are_cells_of(table_.spec().base, events.made_of)) remarks_.emplace_back(own_cells_text);
  if (const ModulusMap* const square = is_elsewhere ? square_.table(events.flow.exponent) : nullptr) {
    stationary.emplace(table_, *square);
    square_table_ = square->origin().identifier;
    unsettled_ = stationary->unsettled();
  }
  CourseCells cells = course_cells(events, name, contraction_um, table_, stationary ? &*stationary : nullptr);
  for (CourseCell& cell : cells.cells) rows_.push_back({name, std::move(cell), events.flow});
  outside_places_ += cells.outside_places;
  outside_areas_ += cells.outside_areas;
  remarks_.push_back("recording: " + name);
  remarks_.push_back(fmt::format("end of the contraction: pos_x = {} um", contraction_um));
  for (const auto& lines : {events.settings, remarks(events)})
    remarks_.insert(remarks_.end(), lines.begin(), lines.end());
}

CourseRow CourseTable::told(const Row& row, std::size_t number) const {
  CourseEstimate estimate = TimeCourse(table_).cell(row.cell.images);
  const double factor = section_factor_of({&row.cell.images, 1});
  const SectionErrors errors = section_errors(factor, unsettled_);
  const Physical in = physical(table_, row.flow);
  CourseRow told{.recording = row.recording,
                 .cell = double(number),
                 .events = double(row.cell.images.size()),
                 .first_place_um = row.cell.images.front().place_um * in.length,
                 .last_place_um = row.cell.images.back().place_um * in.length,
                 .radius_um = estimate.radius_um * in.length,
                 .chi_squared = estimate.chi_squared,
                 .section_factor = factor,
                 .section_error = errors.modulus,
                 .drawn_out = TimeCourse(table_).drawn_out(row.cell.images, estimate.young_modulus_kPa.value,
                                                           estimate.time_ms.value)};
  estimate.young_modulus_kPa = widened(estimate.young_modulus_kPa, errors.modulus);
  estimate.viscosity_Pas = widened(estimate.viscosity_Pas, errors.viscosity);
  told.young_modulus_kPa = times(estimate.young_modulus_kPa, in.modulus);
  told.viscosity_Pas = times(estimate.viscosity_Pas, in.viscosity);
  told.status = status_of(estimate);
  for (std::size_t i = 0; i < row.cell.events.size(); ++i)
    told.event_numbers += fmt::format("{}{}", i == 0 ? "" : " ", row.cell.events[i]);
  return told;
}

std::string CourseTable::section_text(const std::vector<CellImages>& cells) const {
  if (square_table_.empty()) return std::string(is_of_square() ? no_thinning_text : no_square_text);
  const double factor = section_factor_of(cells);
  const SectionErrors errors = section_errors(factor, unsettled_);
  return fmt::format(
      "{}: c3 was divided by {:.3f} (mean), as {} says of stationary solids; what may be left, {:.1f} % of E and "
      "{:.1f} % of the viscosity, is in the intervals",
      is_of_square() ? "the liquid is not shear-thinning as that of the table"
                     : "the channel is square, and the table one of the tube of equal pressure drop",
      factor, square_table_, 100 * errors.modulus, 100 * errors.viscosity);
}

std::string CourseTable::elongation_text(const CourseReport& report) const {
  constexpr double worth_a_word = 0.02;
  std::vector<double> excess, factor;
  const auto take = [&](const DrawnOut& cell) {
    excess.push_back(cell.mode_2_excess);
    factor.push_back(cell.factor);
  };
  const PopulationEstimate& p = report.population;
  const Physical in = physical(table_, rows_.front().flow);
  for (const CourseRow& row : report.rows) take(row.drawn_out);
  // Of cells that were seen once the population determines what they are.
  if (report.rows.empty())
    for (const Row& row : rows_)
      take(TimeCourse(table_).drawn_out(
          row.cell.images, p.young_modulus_kPa.value / in.modulus,
          3 * p.viscosity_Pas.value / p.young_modulus_kPa.value * in.modulus / in.viscosity));
  const Median beyond = median_with_error(excess), multiplied = median_with_error(factor);
  if (!(beyond.value > worth_a_word)) return {};
  return fmt::format(
      "the cells are elongated along the flow (c2 {:.4f} +- {:.4f} beyond that of the table's cells, median): c3 was "
      "multiplied by {:.3f} +- {:.3f} (median), as for solids elongated by a tension of the liquid that is constant "
      "along the channel; for cells with a cortex (flat rear, straight flanks) E and viscosity mean little, see "
      "`rheocyte extract`",
      beyond.value, beyond.error, multiplied.value, multiplied.error);
}

namespace {

/// Of the cells that the table can describe; of fewer than half of all there is no number.
std::string population_text(const PopulationEstimate& p, std::size_t cells) {
  if (2 * p.cells < cells)
    return fmt::format(
        "no modulus and viscosity of the population are reported: only {} of {} cells can be cells of the table, and "
        "their medians would not be those of all",
        p.cells, cells);
  return fmt::format(
      "population: Young's modulus {}, viscosity {} ({} of {} cells); spread by a factor of {:.2f} and {:.2f}",
      with_interval(p.young_modulus_kPa, "kPa"), with_interval(p.viscosity_Pas, "Pa s"), p.cells, cells,
      std::exp(p.modulus_spread), std::exp(p.viscosity_spread));
}

}  // namespace

void CourseTable::check_places(const std::vector<CourseCell>& cells) const {
  std::size_t inside = 0;
  bool is_seen_again = false;
  for (const CourseCell& cell : cells) {
    inside += cell.images.size();
    is_seen_again = is_seen_again || seen_um(cell.images) >= min_seen_um;
  }
  if (!is_seen_again && inside < outside_places_) {
    const double length = rows_.empty() ? 1 : physical(table_, rows_.front().flow).length;
    throw UserError(
        fmt::format("rheocyte: {} of {} events do not lie {:.3g} to {:.3g} um downstream of the end of the "
                    "contraction, where the dynamic table {} has cells; is --contraction-um right?",
                    outside_places_, inside + outside_places_, table_.spec().first_um * length,
                    table_.spec().last_um * length, table_.spec().identifier));
  }
  check_places_seen(cells);
}

CourseReport CourseTable::report(const Watch& watch) const {
  std::vector<CourseCell> cells;
  std::vector<CellImages> images;
  for (const Row& row : rows_) {
    cells.push_back(row.cell);
    images.push_back(row.cell.images);
  }
  check_places(cells);
  CourseReport report;
  std::size_t seen_again = 0;
  for (const Row& row : rows_) {
    watch.go_on();
    if (seen_um(row.cell.images) >= min_seen_um) report.rows.push_back(told(row, ++seen_again));
  }
  report.remarks = {fmt::format("rheocyte {} time-course", version),
                    fmt::format("dynamic table: {}", table_.spec().identifier)};
  report.remarks.insert(report.remarks.end(), remarks_.begin(), remarks_.end());
  report.lines.push_back(
      fmt::format("{} cells, {} of them seen over at least {:g} um; {} events at places and {} with "
                  "areas that the table does not have",
                  cells.size(), seen_again, min_seen_um, outside_places_, outside_areas_));
  if (are_elsewhere_) report.lines.push_back(section_text(images));
  if (cells.size() >= min_population) {
    PopulationEstimate& population = report.population = TimeCourse(table_).population(images, watch);
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
    report.lines.push_back(population_text(population, cells.size()));
    if (2 * population.cells < cells.size()) population = {};
  }
  if (auto text = elongation_text(report); !text.empty()) report.lines.push_back(std::move(text));
  report.remarks.insert(report.remarks.end(), report.lines.begin(), report.lines.end());
  return report;
}

std::string course_text(const CourseReport& report) {
  return rows_text(course_columns(), report.rows) + commented(report.remarks);
}

}  // namespace rheocyte
