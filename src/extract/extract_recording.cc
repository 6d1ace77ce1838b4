#include "extract/extract_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <system_error>

#include "case/user_error.h"
#include "extract/event_table.h"
#include "extract/extract_settings.h"
#include "measurement/companion_file.h"
#include "measurement/shape_source.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t block_of_scalars = 1 << 17;   // 1 MiB per column, a chunk of what is written
constexpr std::size_t block_of_outlines = 1 << 12;  // progress stays visible when every event takes microseconds

std::string program() { return fmt::format("rheocyte {}", version); }

PixelUse pixel_use(const ExtractOptions& options) {
  if (options.no_pixelation) return PixelUse::ignore;
  return options.no_area_correction ? PixelUse::correct_deformation : PixelUse::correct;
}

std::string corrected_for_pixels(const MeasuringConditions& conditions, const ModulusTable& table) {
  if (conditions.pixel_size_um == 0) return "nothing";
  return table.is_own() && conditions.correct_area ? "area and deformation" : "deformation";
}

std::string meaning_of_states() {
  std::string text = "state of emodulus:";
  for (std::size_t k = 0; k < names_of_modulus_states.size(); ++k)
    text += fmt::format("{} {} {}", k == 0 ? "" : ",", k, names_of_modulus_states[k]);
  return text;
}

// The columns of one block of events.
struct Columns {
  std::vector<double> area, deformation, viscosity, modulus, standard_error, state_numbers, other_modulus;
  std::vector<ModulusState> states, other_states;
  std::vector<char> inside;  // the gates

  void resize(std::size_t count) {
    for (auto* const column :
         {&area, &deformation, &viscosity, &modulus, &standard_error, &state_numbers, &other_modulus})
      column->resize(count);
    states.resize(count);
    other_states.resize(count);
  }
};

/// One recording on its way through the blocks.
class Extraction {
 public:
  Extraction(const Recording& recording, const ExtractOptions& options, const ModulusTables& tables)
      : recording_(recording),
        settings_(extract_settings(options.measuring, pixel_use(options), recording)),
        tables_(tables.choose(settings_.flow_exponent)),
        shapes_(recording, settings_.pixel_size_um),
        gates_(options.measuring.gates),
        features_(recording, shapes_) {
    gates_.check(features_, recording.file().string());
  }

  const ModulusTable& table() const { return *tables_.used; }

  std::size_t block() const {
    const auto stored = [](const std::string& source) { return source != "mask" && source != "contour"; };
    return stored(shapes_.area_from()) && stored(shapes_.deformation_from()) ? block_of_scalars : block_of_outlines;
  }

  const Columns& compute(std::size_t first, std::size_t count) {
    Columns& c = columns_;
    c.resize(count);
    shapes_.read(first, c.area, c.deformation);
    outside_temperature_ += settings_.viscosities(recording_, first, c.viscosity);
    const MeasuredEvents events{c.area, c.deformation, c.viscosity};
    if (tables_.other) {
      // Its standard errors are overwritten by those that count.
      tables_.other->estimate(settings_.conditions, events, {c.other_modulus, c.standard_error, c.other_states});
    }
    table().estimate(settings_.conditions, events, {c.modulus, c.standard_error, c.states});
    if (!gates_.empty()) shut_out(first);
    for (std::size_t i = 0; i < count; ++i) c.state_numbers[i] = static_cast<double>(c.states[i]);
    collect();
    return c;
  }

  ExtractSummary summary() {
    ExtractSummary s = summary_;
    s.events = recording_.events();
    s.modulus_kPa = distribution_of(moduli_);
    s.mean_viscosity_mPas = viscosity_sum_ / static_cast<double>(viscosities_);
    s.median_standard_error_kPa = median_of(standard_errors_);
    s.table = table().identifier();
    s.gates = gates_.description();
    s.corrected = corrected_for_pixels(settings_.conditions, table());
    s.medium = settings_.medium_text();
    s.viscosity_model = settings_.model_text();
    s.temperature = settings_.temperature_text();
    s.area_from = shapes_.area_from();
    s.deformation_from = shapes_.deformation_from();
    s.conditions = settings_.conditions;
    s.warnings = recording_.remarks();
    s.warnings.insert(s.warnings.end(), settings_.warnings.begin(), settings_.warnings.end());
    if (outside_temperature_ > 0) s.warnings.push_back(settings_.outside_temperature_text(outside_temperature_));
    if (tables_.other) s.warnings.push_back(comparison());
    if (recording_.has_scalar("emodulus"))
      s.warnings.emplace_back("the recording has a feature emodulus of another program; it was not used.");
    return s;
  }

  std::vector<std::string> lines() const {
    std::vector<std::string> lines{
        fmt::format("table: {}", table().description()),
        fmt::format("area from {}, deformation from {}", shapes_.area_from(), shapes_.deformation_from()),
        fmt::format("corrected for pixels: {}", corrected_for_pixels(settings_.conditions, table()))};
    const auto settings = settings_.lines();
    lines.insert(lines.end(), settings.begin(), settings.end());
    if (!gates_.empty()) lines.push_back("only events with " + gates_.description());
    return lines;
  }

 private:
  // Where a table of the matching liquid and one of a Newtonian liquid are at hand, both are used.
  std::string comparison() const {
    const auto way = [](const ModulusTable& table) {
      return table.flow_exponent() < 1
                 ? fmt::format("{} (its liquid has the exponent {:.3g})", table.identifier(), table.flow_exponent())
                 : fmt::format("{} with the effective viscosity", table.identifier());
    };
    const std::string text = fmt::format("the medium thins in shear (exponent {:.3g}); moduli are from {}",
                                         settings_.flow_exponent, way(table()));
    if (compared_ == 0) return text + ".";
    const double percent = 100 * std::expm1(log_ratios_ / static_cast<double>(compared_));
    return fmt::format("{}; those from {} are {:.1f} % {} (geometric mean of {} events).", text, way(*tables_.other),
                       std::abs(percent), percent < 0 ? "smaller" : "greater", compared_);
  }

  void collect() {
    for (std::size_t i = 0; i < columns_.states.size(); ++i) {
      ++summary_.counts[static_cast<std::size_t>(columns_.states[i])];
      if (has_modulus(columns_.states[i])) take_modulus(i);
      if (!std::isfinite(columns_.viscosity[i])) continue;
      viscosity_sum_ += columns_.viscosity[i];
      ++viscosities_;
    }
  }

  void shut_out(std::size_t first) {
    Columns& c = columns_;
    c.inside.resize(c.states.size());
    gates_.apply(features_, first, c.inside);
    for (std::size_t i = 0; i < c.inside.size(); ++i) {
      if (c.inside[i]) continue;
      c.modulus[i] = c.standard_error[i] = std::numeric_limits<double>::quiet_NaN();
      c.states[i] = ModulusState::gated;
    }
  }

  void take_modulus(std::size_t i) {
    moduli_.push_back(columns_.modulus[i]);
    if (table().is_own()) standard_errors_.push_back(static_cast<float>(columns_.standard_error[i]));
    if (!tables_.other || !has_modulus(columns_.other_states[i])) return;
    log_ratios_ += std::log(columns_.other_modulus[i] / columns_.modulus[i]);
    ++compared_;
  }

  const Recording& recording_;
  ExtractSettings settings_;
  ModulusTables::Choice tables_;
  ShapeSource shapes_;
  Gates gates_;
  EventFeatures features_;
  Columns columns_;
  ExtractSummary summary_;
  std::vector<double> moduli_;
  std::vector<float> standard_errors_;
  double viscosity_sum_ = 0, log_ratios_ = 0;
  std::size_t viscosities_ = 0, compared_ = 0, outside_temperature_ = 0;
};

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  char text[32] = "";
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

// Paths under which the original is looked for: where it is now, seen from the companion, and beside the companion.
std::vector<std::string> paths_to(const fs::path& original, const fs::path& companion) {
  std::error_code error;
  const fs::path absolute = fs::weakly_canonical(fs::absolute(original), error);
  const fs::path relative = fs::relative(absolute, fs::absolute(companion).parent_path(), error);
  std::vector<std::string> paths{absolute.string()};
  for (const auto& path : {relative.string(), original.filename().string()})
    if (!path.empty() && std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
  return paths;
}

void describe(CompanionFile& companion, const ExtractOutput& output, const Recording& recording,
              const Extraction& extraction) {
  companion.add_user_metadata("rheocyte emodulus", "Young's modulus (kPa), with the settings in the log");
  companion.add_user_metadata("rheocyte userdef0", meaning_of_states());
  if (extraction.table().is_own())
    companion.add_user_metadata("rheocyte userdef1", "standard error of emodulus (kPa), of pixels and of the table");
  companion.add_user_metadata("rheocyte table", extraction.table().identifier());
  std::vector<std::string> log{program() + " extract", "time: " + now_utc(),
                               "recording: " + recording.file().filename().string()};
  const auto settings = extraction.lines();
  log.insert(log.end(), settings.begin(), settings.end());
  companion.add_log("rheocyte-extract", log);
  companion.add_basin(paths_to(recording.file(), output.companion));
}

void publish(const fs::path& file) {
  std::error_code error;
  fs::rename(unfinished(file), file, error);
  if (error)
    throw UserError(fmt::format("{}: cannot be put in its place ({}).", one_line(file.string(), 300), error.message()));
}

}  // namespace

fs::path unfinished(const fs::path& file) { return file.string() + "~"; }

ExtractSummary extract_recording(const fs::path& file, const ExtractOutput& output, const ExtractOptions& options,
                                 const ModulusTables& tables, const std::function<void(double)>& on_progress) {
  const Recording recording(file);
  Extraction extraction(recording, options, tables);
  const bool has_errors = extraction.table().is_own();
  CompanionFile companion(unfinished(output.companion), recording, program());
  describe(companion, output, recording, extraction);
  companion.add_feature("emodulus");
  companion.add_feature("userdef0");
  if (has_errors) companion.add_feature("userdef1");
  std::unique_ptr<EventTable> table;
  if (!options.no_tsv) {
    auto remarks = extraction.lines();
    remarks.insert(remarks.begin(), {program() + " extract", "recording: " + file.string()});
    table = std::make_unique<EventTable>(unfinished(output.events), remarks, has_errors);
  }
  const std::size_t events = recording.events(), block = extraction.block();
  for (std::size_t first = 0; first < events; first += block) {
    const std::size_t count = std::min(block, events - first);
    const Columns& c = extraction.compute(first, count);
    companion.write("emodulus", first, c.modulus);
    companion.write("userdef0", first, c.state_numbers);
    if (has_errors) companion.write("userdef1", first, c.standard_error);
    if (table) table->append({c.area, c.deformation, c.viscosity, c.modulus, c.standard_error, c.states});
    on_progress(static_cast<double>(first + count) / static_cast<double>(events));
  }
  companion.close();
  if (table) table->close();
  if (table) publish(output.events);
  publish(output.companion);
  return extraction.summary();
}

}  // namespace rheocyte
