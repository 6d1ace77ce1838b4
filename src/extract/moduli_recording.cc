#include "extract/moduli_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "events/direction_of_cells.h"
#include "events/event_pass.h"
#include "events/event_reader.h"
#include "events/plausibility.h"
#include "events/settings_hash.h"
#include "infer/shape_map.h"
#include "numeric/no_value.h"
#include "numeric/quantile.h"
#include "shelf/modulus_tables.h"
#include "shelf/square_section.h"
#include "store/build_info.h"
#include "store/tasks.h"

namespace rheocyte {

namespace {

constexpr std::size_t events_between_progress = 256, events_of_survey = 256;

/// One recording on its way through the blocks.
class Fits {
 public:
  /// `watch` is asked from event to event.
  Fits(const Recording& recording, const ModuliOptions& options, const ModuliTables& tables, int threads, Watch watch)
      : watch_(std::move(watch)),
        threads_(threads),
        events_(recording, options.measuring, {.outlines = OutlineUse::needed, .outlines_for = use_of_outlines}),
        section_(section_seen(options.section, events_.facts().made_of, tables.computed().content.spec.base)),
        table_(tables.seen_in(section_, conditions().flow.exponent, events_.facts().made_of)),
        table_name_(tables.name()),
        is_changed_(&table_ != &tables.computed()),
        is_told_(options.section),
        outline_noise_um_(options.outline_noise_um.value_or(0)),
        solids_(std::string(), section_),
        shapes_of_solids_(solids_.shapes(conditions().flow.exponent)),
        elongated_solids_(solids_.elongated(conditions().flow.exponent)),
        moduli_(events_.settings(), options, table_, section_) {
    events_.turn_downstream(table_.sign_of_asymmetry());
    axial_.is_of_elongated_cells = table_.between.is_elongated();
    axial_.is_given = options.axial_tension_Pa.has_value();
    settings_hash_ = hash_of_settings(options);
  }

  /// What the cells have in common, before the first block. The mean cell has a tension of its own, which is a test
  /// of the common one.
  void survey(const Recording& recording, const ModuliOptions& options) {
    const std::vector<MeasuredCell> cells = cells_for_survey(recording, options);
    check_outlines(recording, cells);
    median_ = moduli_.median_cell(cells);
    survey_law(cells);
    if (!axial_.law.is_found) common_errors_ = moduli_.common_errors(cells);
  }

  void check_outlines(const Recording& recording, std::span<const MeasuredCell> cells) const {
    if (cells.empty()) return;
    std::vector<double> modes_7;
    for (const MeasuredCell& cell : cells) modes_7.push_back(cell.shape(feature_of_mode(7)));
    check_outline_noise(recording.file(), outline_noise_um_, events_.settings().pixel_size_um,
                        {median_of(cells).shape, modes_7});
  }

  void survey_law(const std::vector<MeasuredCell>& cells) {
    if (!axial_.is_of_elongated_cells) return;
    std::vector<double> wall_stresses;
    for (const MeasuredCell& cell : cells) wall_stresses.push_back(wall_shear_stress_Pa(cell.flow));
    axial_.wall_stress_Pa = median_of(wall_stresses);
    const auto area_um2 = events_.gates().limits_of("area_um");
    moduli_.tell_law(cells, log_area_gate(area_um2.min, area_um2.max), watch_, axial_);
    moduli_.know_tension(axial_.law.axial_tension);
  }

  /// What holds for all events.
  std::vector<std::string> lines(const ModuliOptions& options) const {
    std::vector<std::string> lines{
        fmt::format("rheocyte {} moduli", version),
        "recording: " + events_.recording().file().string(),
        "table: " + table_name_ + liquid_text(),
        way_text(options),
        section_text(),
        fmt::format("errors of the outline beside those of the pixels: {:g} um", outline_noise_um_),
        fmt::format("direction of the cells: {}", direction_text(events_.facts().direction))};
    for (const auto& line : law_lines(axial_)) lines.push_back(line);
    const RecordingFacts& facts = events_.facts();
    lines.insert(lines.end(), facts.settings.begin(), facts.settings.end());
    if (!facts.gates.empty()) lines.push_back("only events with " + facts.gates);
    lines.push_back("settings hash: " + settings_hash_);
    return lines;
  }

  /// A block of events, until the next one.
  ModuliBlock take(std::size_t first, std::size_t count) {
    events_.read(first, count);
    seen_.clear();
    for (std::size_t i = 0; i < count; ++i) seen_.push_back(events_.shape(first + i));
    compare(seen_);
    const auto viscosity = events_.viscosity_mPas();
    estimates_.assign(count, gated());
    Tasks fits;
    for (std::size_t i = 0; i < count; ++i)
      if (events_.is_inside(i))
        fits.add(0, [this, i, viscosity](int thread) {
          if (thread == 0) watch_.go_on();
          estimates_[i] = moduli_.fit(seen_[i], viscosity[i]);
        });
    fits.run(threads_);
    for (std::size_t i = 0; i < count; ++i) {
      if (estimates_[i].status == ModuliStatus::no_data && events_.is_cut(first + i)) {
        estimates_[i].status = ModuliStatus::cut;
        events_.count_cut(1);
      }
      tally_.take(estimates_[i]);
      if (axial_.is_of_elongated_cells && has_cell(estimates_[i])) {
        const CellCoordinates& cell = estimates_[i].cell;
        slopes_.take(seen_[i], moduli_.errors_in_picture(cell), cell);
      }
    }
    return {seen_, viscosity, estimates_, excess_, solids_values_.block()};
  }

  /// Behind all events.
  std::vector<std::string> last_remarks() {
    slopes_.finish(table_.between, axial_);
    return slope_lines(axial_);
  }

  ModuliSummary summary() {
    ModuliSummary s = tally_.summary(common_errors_, axial_.law);
    s.axial = axial_;
    s.median_cell = median_;
    s.outline_noise_um = outline_noise_um_;
    s.settings_hash = settings_hash_;
    static_cast<RecordingFacts&>(s) = events_.facts();
    s.warnings = remarks(s);
    if (auto missing = missing_text(s); !missing.empty()) s.warnings.push_back(std::move(missing));
    if (is_square()) {
      s.warnings.push_back(section_text());
    } else if (!is_told_) {
      s.warnings.emplace_back(own_cells_text);
    } else if (std::abs(conditions().flow.exponent - table_.simulated.exponent) > flow_exponent_tolerance) {
      s.warnings.push_back(fmt::format(
          "the medium is shear-thinning with the exponent {:.3g}, the table's liquid has {:.3g}, with the same "
          "viscosity at the wall. Moduli are off by up to 5 %{}",
          conditions().flow.exponent, table_.simulated.exponent,
          axial_.is_of_elongated_cells ? ", under an axial tension effective moduli by up to a third." : "."));
    }
    if (s.resolved() == 0 && s.with_stiffness() > 0)
      s.warnings.emplace_back(
          "no event determines bulk and cortex separately; E + E2D/r0 is known, for some events perhaps single "
          "moduli.");
    return s;
  }

 private:
  std::string liquid_text() const {
    return is_changed_
               ? fmt::format(", its states changed to a liquid with the exponent {:.4g}", table_.simulated.exponent)
               : "";
  }

  std::string way_text(const ModuliOptions& options) const {
    return fmt::format(
        "by {}; {}",
        axial_.is_of_elongated_cells ? "area and modes 2 .. 7 of the contour" : "area and modes 2 .. 6 of the contour",
        options.fit_tension || axial_.is_of_elongated_cells ? "the tension of the cortex is fitted"
                                                            : "the tension is that of the table");
  }

  std::string hash_of_settings(const ModuliOptions& options) const {
    std::vector<std::string> lines = events_.facts().decisive;
    const TableSpec& spec = table_.content.spec;
    lines.push_back(fmt::format("table: {} {}", spec.identifier, spec_hash(spec)));
    lines.push_back(way_text(options));
    lines.push_back(fmt::format("section {}, outline noise {} um", int(section_), outline_noise_um_));
    if (options.axial_tension_Pa) lines.push_back(fmt::format("axial tension {} Pa", *options.axial_tension_Pa));
    return settings_hash(lines);
  }

  bool is_square() const { return section_ == Section::square; }
  const MeasuringConditions& conditions() const { return events_.conditions(); }

  static bool has_cell(const ModuliEstimate& e) {
    return e.status == ModuliStatus::resolved || e.status == ModuliStatus::not_told_apart;
  }

  /// All within the gates, so that nothing depends on their order.
  std::vector<MeasuredCell> cells_for_survey(const Recording& recording, const ModuliOptions& options) const {
    EventReader events(recording, options.measuring, {.outlines = OutlineUse::needed, .outlines_for = use_of_outlines});
    events.turn(events_.facts().direction);
    std::vector<MeasuredCell> cells;
    for (std::size_t first = 0; first < recording.events(); first += events_of_survey) {
      const std::size_t count = std::min(events_of_survey, recording.events() - first);
      events.read(first, count);
      for (std::size_t i = 0; i < count; ++i) {
        if (!events.is_inside(i)) continue;
        watch_.go_on();
        MeasuredCell cell = moduli_.measured(events.shape(first + i), events.viscosity_mPas()[i]);
        if (cell.shape.allFinite() && std::isfinite(cell.flow.viscosity_mPas)) cells.push_back(std::move(cell));
      }
    }
    return cells;
  }

  std::string section_text() const {
    if (!is_square()) return "channel: the tube of equal pressure drop, as in the table";
    return "the channel is square, and the table one of the tube of equal pressure drop: its shapes are changed by a "
           "law for stationary cells, and what that leaves is counted as an error.";
  }

  /// With the solids of the table that comes with the program.
  void compare(std::span<const ShapeVector> seen) {
    constexpr int mode_2 = int(ShapeFeature::first_mode);
    std::vector<double> area, deformation, ratio;
    std::array<std::vector<double>, 4> modes;  // from c_2 on
    for (std::size_t i = 0; i < seen.size(); ++i) {
      area.push_back(std::exp(seen[i](0)));
      deformation.push_back(seen[i](1));
      ratio.push_back(events_.is_inside(i) ? 1 / std::sqrt(seen[i](2)) : no_value);
      for (std::size_t k = 0; k < modes.size(); ++k) modes[k].push_back(seen[i](mode_2 + int(k)));
    }
    excess_.assign(seen.size(), {no_value, no_value, no_value, no_value});
    solids_values_.assign(seen.size());
    const MeasuredEvents events{area, deformation, events_.viscosity_mPas()};
    if (shapes_of_solids_) shapes_of_solids_->compare(conditions(), events, ratio, excess_);
    if (elongated_solids_)
      elongated_solids_->estimate(conditions(), events, {ElongatedBy::modes, modes[0], modes[1], modes[2], modes[3]},
                                  solids_values_.estimates());
  }

  static ModuliEstimate gated() {
    ModuliEstimate estimate;
    estimate.status = ModuliStatus::gated;
    return estimate;
  }

  Watch watch_;
  int threads_;
  EventReader events_;
  Section section_;
  const ModuliTable& table_;
  std::string table_name_;
  bool is_changed_;
  bool is_told_;  ///< by the user
  double outline_noise_um_;
  std::string settings_hash_;
  ModulusTables solids_;
  const ShapeMap* shapes_of_solids_;
  const ElongatedLiquid* elongated_solids_;
  EventModuli moduli_;
  AxialSummary axial_;
  MedianCell median_;
  CommonErrors common_errors_;
  SlopeTally slopes_;
  std::vector<ShapeExcess> excess_;
  ElongationValues solids_values_;  ///< as if they were solids
  std::vector<ShapeVector> seen_;
  std::vector<ModuliEstimate> estimates_;
  ModuliTally tally_;
};

}  // namespace

ModuliSummary moduli_of_recording(const std::filesystem::path& path, const ModuliOptions& options,
                                  const ModuliTables& tables, int threads, ModuliConsumer& consumer,
                                  const TellProgress& report_progress) {
  Recording recording(path);
  EventPass pass(recording, report_progress);
  Fits fits(recording, options, tables, threads, pass.watch());
  fits.survey(recording, options);
  consumer.begin(recording, fits.lines(options));
  pass.in_blocks(events_between_progress,
                 [&](std::size_t first, std::size_t count) { consumer.take(first, fits.take(first, count)); });
  consumer.end(fits.last_remarks());
  return fits.summary();
}

}  // namespace rheocyte
