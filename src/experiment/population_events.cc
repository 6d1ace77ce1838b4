#include "experiment/population_events.h"

#include <cmath>
#include <memory>

#include "case/refuse_path.h"
#include "events/direction_of_cells.h"
#include "events/event_pass.h"
#include "events/outlined_events.h"
#include "events/plausibility.h"
#include "measurement/metadata.h"
#include "numeric/quantile.h"

namespace rheocyte {
namespace {

constexpr std::size_t population_block = 256;
constexpr int modes_seen = int(SeenMeasure::viscosity_mPas) - int(SeenMeasure::mode_2);
constexpr double sign_of_cells_of_tables = 1;  ///< of c_3 of cells that move towards +x
constexpr std::string_view stored_inertia_ratio = "inert_ratio_cvx";

using Seen = std::array<double, seen_measures>;
double& seen_at(Seen& seen, SeenMeasure m) { return seen[std::size_t(m)]; }

void add(const Seen& seen, std::size_t event, PopulationEvents& all) {
  for (const double value : seen)
    if (!std::isfinite(value)) {
      ++all.without_numbers;
      return;
    }
  all.number.push_back(double(event + 1));
  for (std::size_t m = 0; m < seen.size(); ++m) all.seen[m].push_back(seen[m]);
}

void describe(const ExtractSettings& settings, const Gates& gates, StiffnessMeasure by, PopulationEvents& all) {
  all.flow = settings.conditions.flow;
  all.pixel_size_um = settings.pixel_size_um;
  all.settings = settings.lines();
  all.medium = settings.medium_text();
  if (settings.buffer) all.temperature_C = settings.temperature_C;
  all.warnings.insert(all.warnings.end(), settings.warnings.begin(), settings.warnings.end());
  all.gates = gates.description();
  all.gates_beside_the_model = by == StiffnessMeasure::asymmetry ? gates.description_without({"area_um"})
                                                                 : gates.description_without({"area_um", "deform"});
  const auto area = gates.limits_of("area_um"), deformation = gates.limits_of("deform");
  all.least_area_um2 = area.min, all.greatest_area_um2 = area.max;
  all.least_deformation = deformation.min, all.greatest_deformation = deformation.max;
}

/// By contours or masks.
class OutlinedReader {
 public:
  OutlinedReader(const Recording& recording, const MeasuringOptions& options, StiffnessMeasure by,
                 PopulationEvents& all)
      : all_(all), events_(recording, options, "the asymmetry of each outline is computed") {
    describe(events_.settings(), events_.gates(), by, all);
    all.has_outlines = true;
    all.direction = events_.turn_downstream(sign_of_cells_of_tables);
    if (all.direction < 0)
      all.warnings.emplace_back(
          "the mean asymmetry is negative: the cells move towards -x, and the image is mirrored.");
    if (all.direction == 0) all.warnings.emplace_back("the direction of the cells cannot be seen and is taken as +x.");
  }

  void take(std::size_t first, std::size_t count) {
    constexpr int mode_2 = int(ShapeFeature::first_mode);
    events_.read(first, count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!events_.is_inside(i)) {
        ++all_.gated;
        continue;
      }
      const ShapeVector shape = events_.shape(first + i);
      cut_ += !shape.allFinite() && events_.is_cut(first + i);
      Seen seen;
      seen_at(seen, SeenMeasure::area_um2) = std::exp(shape(int(ShapeFeature::area_um2)));
      seen_at(seen, SeenMeasure::deformation) = shape(int(ShapeFeature::deformation));
      seen_at(seen, SeenMeasure::inertia_ratio) = 1 / std::sqrt(shape(int(ShapeFeature::moment_ratio)));
      for (int k = 0; k < modes_seen; ++k) seen[std::size_t(int(SeenMeasure::mode_2) + k)] = shape(mode_2 + k);
      seen_at(seen, SeenMeasure::viscosity_mPas) = events_.viscosity_mPas()[i];
      add(seen, first + i, all_);
    }
  }

  std::size_t outside_temperature() const { return events_.outside_temperature(); }
  std::size_t cut() const { return cut_; }
  const ExtractSettings& settings() const { return events_.settings(); }

 private:
  PopulationEvents& all_;
  OutlinedEvents events_;
  std::size_t cut_ = 0;
};

/// By stored features.
class StoredReader {
 public:
  StoredReader(const Recording& recording, const MeasuringOptions& options, StiffnessMeasure by, PopulationEvents& all)
      : all_(all),
        recording_(recording),
        settings_(extract_settings(options, PixelUse::fit, recording)),
        shapes_(recording, settings_.pixel_size_um),
        features_(recording, shapes_),
        gates_(options.gates) {
    gates_.check(features_);
    describe(settings_, gates_, by, all);
    all.has_inertia_ratios = recording.has_scalar(std::string(stored_inertia_ratio));
    if (!all.has_inertia_ratios)
      all.warnings.emplace_back(
          "there are neither outlines nor inertia ratios (inert_ratio_cvx): E is that of cells which nothing but the "
          "flow "
          "elongates, and whether these are such cells is unknown.");
  }

  void take(std::size_t first, std::size_t count) {
    std::vector<double> area(count), deformation(count), ratio(count), viscosity(count);
    std::vector<char> inside(count);
    outside_ += settings_.viscosities(recording_, first, viscosity);
    gates_.apply(features_, first, inside);
    shapes_.read(first, area, deformation);
    if (all_.has_inertia_ratios) recording_.read_scalar(std::string(stored_inertia_ratio), first, ratio);
    for (std::size_t i = 0; i < count; ++i) {
      if (!inside[i]) {
        ++all_.gated;
        continue;
      }
      Seen seen{};
      seen_at(seen, SeenMeasure::area_um2) = area[i];
      seen_at(seen, SeenMeasure::deformation) = deformation[i];
      seen_at(seen, SeenMeasure::inertia_ratio) = ratio[i];
      seen_at(seen, SeenMeasure::viscosity_mPas) = viscosity[i];
      add(seen, first + i, all_);
    }
  }

  std::size_t outside_temperature() const { return outside_; }
  static std::size_t cut() { return 0; }
  const ExtractSettings& settings() const { return settings_; }

 private:
  PopulationEvents& all_;
  const Recording& recording_;
  ExtractSettings settings_;
  ShapeSource shapes_;
  EventFeatures features_;
  Gates gates_;
  std::size_t outside_ = 0;
};

template <class Reader>
PopulationEvents events_by(Recording& recording, const MeasuringOptions& options, StiffnessMeasure by,
                           const TellProgress& report_progress) {
  PopulationEvents all;
  all.recorded = recording.events();
  all.warnings = recording.remarks();
  all.made_of = recording.metadata().text(made_of_key).value_or("");
  EventPass pass(recording, report_progress);
  Reader reader(recording, options, by, all);
  pass.in_blocks(population_block, [&](std::size_t first, std::size_t count) { reader.take(first, count); });
  if (const auto outside = reader.outside_temperature())
    all.warnings.push_back(reader.settings().outside_temperature_text(outside));
  if (reader.cut() > 0) all.warnings.push_back(cut_text(reader.cut()));
  return all;
}

}  // namespace

ShapeVector PopulationEvents::median_shape() const {
  ShapeVector median = ShapeVector::Zero();
  median(int(ShapeFeature::area_um2)) = std::log(median_of(of(SeenMeasure::area_um2)));
  median(int(ShapeFeature::deformation)) = median_of(of(SeenMeasure::deformation));
  median(int(ShapeFeature::moment_ratio)) = std::pow(median_of(of(SeenMeasure::inertia_ratio)), -2);
  for (int k = 0; k < modes_seen && has_outlines; ++k)
    median(int(ShapeFeature::first_mode) + k) = median_of(seen[std::size_t(int(SeenMeasure::mode_2) + k)]);
  return median;
}

PopulationEvents read_population_events(const std::filesystem::path& file, const MeasuringOptions& options,
                                        StiffnessMeasure by, const TellProgress& report_progress) {
  Recording recording(file);
  if (ShapeSource::has_outlines(recording)) return events_by<OutlinedReader>(recording, options, by, report_progress);
  if (by == StiffnessMeasure::asymmetry)
    refuse_path(
        file,
        "has neither contours nor masks, from which the asymmetry of the outlines follows; populations of solids "
        "are fitted without them with --by odd-deformation, if there are inertia ratios (inert_ratio_cvx), else with "
        "--by "
        "deformation, if nothing but the flow elongates the cells.");
  if (by == StiffnessMeasure::odd_deformation && !recording.has_scalar(std::string(stored_inertia_ratio)))
    refuse_path(
        file,
        "has neither contours nor masks nor inertia ratios (inert_ratio_cvx), so nobody knows how elongated its "
        "cells are; --by deformation fits a population of cells that nothing but the flow elongates.");
  return events_by<StoredReader>(recording, options, by, report_progress);
}

}  // namespace rheocyte
