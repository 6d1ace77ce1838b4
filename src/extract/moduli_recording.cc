#include "extract/moduli_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "case/user_error.h"
#include "extract/event_table.h"
#include "extract/extract_settings.h"
#include "extract/gates.h"
#include "extract/modulus_tables.h"
#include "extract/plausibility.h"
#include "measurement/event_features.h"
#include "measurement/event_outlines.h"
#include "measurement/shape_source.h"
#include "numeric/no_value.h"
#include "store/build_info.h"
#include "store/file_writer.h"

namespace rheocyte {

namespace {

constexpr std::size_t events_between_progress = 256;

const Recording& with_outlines(const Recording& recording) {
  if (!ShapeSource::has_outlines(recording))
    throw UserError(fmt::format("{}: has neither contours nor masks; several moduli need the shape of each cell.",
                                one_line(recording.file().string(), 300)));
  return recording;
}

constexpr std::string_view more_columns =
    "young_modulus_error_kPa\t"
    "cortex_modulus_mN_per_m\tcortex_modulus_error_mN_per_m\ttension_mN_per_m\ttension_error_mN_per_m\t"
    "stiffness_kPa\tstiffness_error_kPa\tchi_squared\tstatus\t"
    "shape_excess\tyoung_modulus_asymmetry_kPa\tstandard_error_asymmetry_kPa\n";

std::string line(std::size_t event, const ShapeVector& seen, double viscosity_mPas, const ModuliEstimate& e) {
  std::string text = fmt::format("{}\t{:.6g}\t{:.6g}\t{:.6g}", event + 1, std::exp(seen(0)), seen(1), viscosity_mPas);
  for (const Modulus m : {Modulus::young, Modulus::cortex, Modulus::tension})
    text += fmt::format("\t{:.6g}\t{:.3g}", e.value(m), e.error(m));
  return text + fmt::format("\t{:.6g}\t{:.3g}\t{:.4g}\t{}", e.stiffness_kPa, e.stiffness_error_kPa, e.chi_squared,
                            name_of(e.status));
}

/// One recording on its way through the blocks.
class Fits {
 public:
  Fits(const Recording& recording, const ModuliOptions& options, const ModuliTable& table)
      : recording_(recording),
        settings_(extract_settings(options.measuring, PixelUse::fit, recording)),
        outlines_(with_outlines(recording), settings_.pixel_size_um),
        shapes_(recording, settings_.pixel_size_um),
        features_(recording, shapes_),
        gates_(options.measuring.gates),
        simulated_exponent_(table.simulated.exponent),
        shapes_of_solids_(solids_.shapes(settings_.conditions.flow.exponent)),
        moduli_(settings_, options, table) {
    gates_.check(features_, recording.file().string());
  }

  /// The names of the columns, and the settings.
  std::string header(const ModuliOptions& options) const {
    std::vector<std::string> remarks{
        fmt::format("rheocyte {} moduli", version), "recording: " + recording_.file().string(),
        "table: " + options.table.string(),
        fmt::format(
            "by {}; {}",
            options.only_figure ? "area, deformation and Lambda1/Lambda2" : "area and modes 2 .. 6 of the contour",
            options.fit_tension ? "the tension is fitted" : "the tension is that of the table")};
    const auto settings = settings_.lines();
    remarks.insert(remarks.end(), settings.begin(), settings.end());
    if (!gates_.empty()) remarks.push_back("only events with " + gates_.description());
    return std::string(first_columns_of_events).append(more_columns) + commented(remarks);
  }

  /// The lines of a block of events.
  std::string take(std::size_t first, std::size_t count) {
    viscosity_.resize(count);
    outside_temperature_ += settings_.viscosities(recording_, first, viscosity_);
    count_inertial();
    inside_.resize(count);
    gates_.apply(features_, first, inside_);
    std::vector<ShapeVector> seen;
    for (std::size_t i = 0; i < count; ++i) seen.push_back(outlines_.features(first + i));
    compare(seen);
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
      const ModuliEstimate estimate = inside_[i] ? moduli_.fit(seen[i], viscosity_[i]) : gated();
      tally_.take(estimate);
      text += line(first + i, seen[i], viscosity_[i], estimate) +
              fmt::format("\t{:.4g}\t{:.6g}\t{:.3g}\n", excess_[i].excess, solid_kPa_[i], solid_error_kPa_[i]);
    }
    return text;
  }

  ModuliSummary summary() {
    ModuliSummary s = tally_.summary();
    s.gates = gates_.description();
    s.warnings = recording_.remarks();
    s.warnings.insert(s.warnings.end(), settings_.warnings.begin(), settings_.warnings.end());
    if (outside_temperature_ > 0) s.warnings.push_back(settings_.outside_temperature_text(outside_temperature_));
    if (inertial_ > 0) s.warnings.push_back(inertia_text(inertial_, max_reynolds_number_));
    if (std::abs(settings_.conditions.flow.exponent - simulated_exponent_) > flow_exponent_tolerance)
      s.warnings.push_back(fmt::format(
          "the medium is shear-thinning with the exponent {:.3g}, the table's liquid has {:.3g}: the viscosity at the "
          "wall stands for both, and moduli are off by up to 5 %, those of large cells most.",
          settings_.conditions.flow.exponent, simulated_exponent_));
    if (s.resolved() == 0 && s.with_stiffness() > 0)
      s.warnings.emplace_back(
          "no event tells bulk and cortex apart; what is known is E + E2D/r0, of some events perhaps single moduli.");
    return s;
  }

 private:
  /// With the solids of the table that comes with the program.
  void compare(std::span<const ShapeVector> seen) {
    constexpr int mode_2 = int(ShapeFeature::first_mode);
    std::vector<double> area, deformation, ratio, second, third;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      area.push_back(std::exp(seen[i](0)));
      deformation.push_back(seen[i](1));
      ratio.push_back(inside_[i] ? 1 / std::sqrt(seen[i](2)) : no_value);
      second.push_back(seen[i](mode_2));
      third.push_back(seen[i](mode_2 + 1));
    }
    excess_.assign(seen.size(), {no_value, no_value, no_value, no_value});
    solid_kPa_.assign(seen.size(), no_value);
    solid_error_kPa_.assign(seen.size(), no_value);
    if (!shapes_of_solids_) return;
    const MeasuredEvents events{area, deformation, viscosity_};
    std::vector<ModulusState> states(seen.size());
    shapes_of_solids_->compare(settings_.conditions, events, ratio, excess_);
    if (shapes_of_solids_->has_asymmetry())
      shapes_of_solids_->estimate(settings_.conditions, events, {second, third},
                                  {solid_kPa_, solid_error_kPa_, states});
  }

  void count_inertial() {
    ChannelFlow flow = settings_.conditions.flow;
    for (const double viscosity_mPas : viscosity_) {
      flow.viscosity_mPas = viscosity_mPas;
      const double reynolds = reynolds_number(buffer_density_kg_per_m3, flow);
      if (!(reynolds > max_reynolds_number)) continue;
      ++inertial_;
      max_reynolds_number_ = std::max(max_reynolds_number_, reynolds);
    }
  }

  static ModuliEstimate gated() {
    ModuliEstimate estimate;
    estimate.status = ModuliStatus::gated;
    return estimate;
  }

  const Recording& recording_;
  ExtractSettings settings_;
  EventOutlines outlines_;
  ShapeSource shapes_;
  EventFeatures features_;
  Gates gates_;
  double simulated_exponent_;
  ModulusTables solids_{std::string(), Section::tube};
  const ShapeMap* shapes_of_solids_;
  EventModuli moduli_;
  std::vector<double> viscosity_;
  std::vector<char> inside_;
  std::vector<ShapeExcess> excess_;
  std::vector<double> solid_kPa_, solid_error_kPa_;  ///< by the asymmetry, as if the cells were solids
  std::size_t outside_temperature_ = 0, inertial_ = 0;
  double max_reynolds_number_ = 0;
  ModuliTally tally_;
};

}  // namespace

ModuliSummary moduli_of_recording(const std::filesystem::path& path, const std::filesystem::path& file,
                                  const ModuliOptions& options, const ModuliTable& table,
                                  const TellProgress& tell_progress) {
  Recording recording(path);
  double done = 0;
  recording.on_piece(now_and_then([&] { tell_progress(done); }));
  Fits fits(recording, options, table);
  FileWriter writer(file);
  writer.append(fits.header(options));
  const std::size_t events = recording.events();
  for (std::size_t first = 0; first < events; first += events_between_progress) {
    const std::size_t count = std::min(events_between_progress, events - first);
    writer.append(fits.take(first, count));
    tell_progress(done = double(first + count) / double(events));
  }
  writer.close();
  return fits.summary();
}

}  // namespace rheocyte
