#include "experiment/population_events.h"

#include <cmath>
#include <utility>

#include "case/refuse_path.h"
#include "events/event_pass.h"
#include "events/event_reader.h"
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

void describe_gates(const Gates& gates, const std::optional<StiffnessMeasure>& by, PopulationEvents& all) {
  const bool is_deformation_modelled = by && by != StiffnessMeasure::asymmetry;
  all.gates_beside_the_model = is_deformation_modelled ? gates.description_without({"area_um", "deform"})
                                                       : gates.description_without({"area_um"});
  const auto area = gates.limits_of("area_um"), deformation = gates.limits_of("deform");
  all.least_area_um2 = area.min, all.greatest_area_um2 = area.max;
  all.least_deformation = deformation.min, all.greatest_deformation = deformation.max;
}

/// By contours or masks; by stored features where there are none.
class PopulationReader {
 public:
  PopulationReader(const Recording& recording, const MeasuringOptions& options,
                   const std::optional<StiffnessMeasure>& by)
      : events_(recording, options, {.outlines = OutlineUse::if_there}) {
    describe_gates(events_.gates(), by, all_);
    all_.has_outlines = events_.has_outlines();
    if (all_.has_outlines)
      find_direction();
    else
      look_for_inertia_ratios(by.has_value());
  }

  void take(std::size_t first, std::size_t count) {
    events_.read(first, count);
    if (all_.has_outlines)
      take_outlines(first, count);
    else
      take_stored(first, count);
  }

  PopulationEvents result() {
    static_cast<RecordingFacts&>(all_) = events_.facts();
    auto sentences = remarks(events_.facts());
    all_.warnings.insert(all_.warnings.begin(), sentences.begin(), sentences.end());
    return std::move(all_);
  }

 private:
  void find_direction() {
    const int direction = events_.turn_downstream(sign_of_cells_of_tables);
    if (direction < 0)
      all_.warnings.emplace_back(
          "the mean asymmetry is negative: the cells move towards -x, and the image is mirrored.");
    if (direction == 0) all_.warnings.emplace_back("the direction of the cells cannot be seen and is taken as +x.");
  }

  void look_for_inertia_ratios(bool are_needed) {
    all_.has_inertia_ratios = events_.recording().has_scalar(std::string(stored_inertia_ratio));
    if (!all_.has_inertia_ratios && are_needed)
      all_.warnings.emplace_back(
          "there are neither outlines nor inertia ratios (inert_ratio_cvx): E is that of cells which nothing but the "
          "flow elongates, and whether these are such cells is unknown.");
  }

  void take_outlines(std::size_t first, std::size_t count) {
    constexpr int mode_2 = int(ShapeFeature::first_mode);
    for (std::size_t i = 0; i < count; ++i) {
      if (!events_.is_inside(i)) continue;
      const ShapeVector shape = events_.shape(first + i);
      if (!shape.allFinite()) events_.count_cut(events_.is_cut(first + i));
      Seen seen;
      seen_at(seen, SeenMeasure::area_um2) = std::exp(shape(int(ShapeFeature::area_um2)));
      seen_at(seen, SeenMeasure::deformation) = shape(int(ShapeFeature::deformation));
      seen_at(seen, SeenMeasure::inertia_ratio) = 1 / std::sqrt(shape(int(ShapeFeature::moment_ratio)));
      for (int k = 0; k < modes_seen; ++k) seen[std::size_t(int(SeenMeasure::mode_2) + k)] = shape(mode_2 + k);
      seen_at(seen, SeenMeasure::viscosity_mPas) = events_.viscosity_mPas()[i];
      add(seen, first + i, all_);
    }
  }

  void take_stored(std::size_t first, std::size_t count) {
    std::vector<double> area(count), deformation(count), ratio(count);
    events_.stored_shapes().read(first, area, deformation);
    if (all_.has_inertia_ratios) events_.recording().read_scalar(std::string(stored_inertia_ratio), first, ratio);
    for (std::size_t i = 0; i < count; ++i) {
      if (!events_.is_inside(i)) continue;
      Seen seen{};
      seen_at(seen, SeenMeasure::area_um2) = area[i];
      seen_at(seen, SeenMeasure::deformation) = deformation[i];
      seen_at(seen, SeenMeasure::inertia_ratio) = ratio[i];
      seen_at(seen, SeenMeasure::viscosity_mPas) = events_.viscosity_mPas()[i];
      add(seen, first + i, all_);
    }
  }

  EventReader events_;
  PopulationEvents all_;
};

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
                                        const std::optional<StiffnessMeasure>& by,
                                        const TellProgress& report_progress) {
  Recording recording(file);
  const bool has_outlines = ShapeSource::has_outlines(recording);
  if (by == StiffnessMeasure::asymmetry && !has_outlines)
    refuse_path(
        file,
        "has neither contours nor masks, from which the asymmetry of the outlines follows. With inertia ratios "
        "(inert_ratio_cvx), real cells, which are longer than the flow makes them, are fitted with --model effective, "
        "solids with --by odd-deformation; else with --by deformation, if nothing but the flow elongates the cells.");
  if (by == StiffnessMeasure::odd_deformation && !has_outlines &&
      !recording.has_scalar(std::string(stored_inertia_ratio)))
    refuse_path(file,
                "has neither contours nor masks nor inertia ratios (inert_ratio_cvx), so the elongation of its cells "
                "is unknown; --by deformation fits a population of cells that nothing but the flow elongates.");
  EventPass pass(recording, report_progress);
  PopulationReader reader(recording, options, by);
  pass.in_blocks(population_block, [&](std::size_t first, std::size_t count) { reader.take(first, count); });
  return reader.result();
}

}  // namespace rheocyte
