#include "events/extract_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/joined.h"
#include "case/refuse_path.h"
#include "case/stripped.h"
#include "case/user_error.h"
#include "events/plausibility.h"
#include "measurement/text_table.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

// A key of the metadata, and what stands for it on the command line and in a case.
struct Quantity {
  const char *key, *unit, *way_out;
  Range range;
};

// Of what is no positive number; with a decimal comma, for example, the text states what is wrong.
std::string what_is_stored(const Recording& recording, const std::string& key) {
  if (!recording.metadata().has(key)) return key + " is missing";
  const auto text = recording.metadata().text(key);
  return text ? fmt::format("{} is \"{}\", which is not a positive number", key, one_line(*text, 40))
              : key + " is not a positive number";
}

double quantity(const Recording& recording, const std::optional<double>& given, const Quantity& wanted) {
  if (given) return *given;
  const auto& [key, unit, way_out, range] = wanted;
  const auto stored = recording.metadata().number(key);
  if (stored && *stored > 0 && !range.contains(*stored))
    refuse_path(recording.file(), fmt::format("{} is {:g}, outside {}; is it in another unit? Give it with {}.", key,
                                              *stored, range_text(range, unit), way_out));
  if (stored && *stored > 0) return *stored;
  refuse_path(recording.file(), fmt::format("{}; give it with {}.", what_is_stored(recording, key), way_out));
}

void check_region(const Recording& recording) {
  const std::string region = in_small_letters(recording.metadata().text("setup:chip region").value_or("channel"));
  if (region != "channel")
    refuse_path(recording.file(),
                fmt::format("was recorded in the {}, where cells are not deformed by the channel; moduli exist "
                            "only for recordings with setup:chip region \"channel\".",
                            one_line(region, 40)));
}

/// What neither the metadata nor the options give, in one sentence; single quantities of .rtdc files have their own.
void check_set_up(const MeasuringOptions& options, PixelUse pixels, const Recording& recording) {
  const bool is_text = is_text_table(recording.file());
  std::vector<std::string> missing;
  const auto need = [&](bool is_given, const char* key, const char* option) {
    if (!is_given && !recording.metadata().has(key)) missing.push_back(fmt::format("{} ({})", key, option));
  };
  need(options.channel_width_um.has_value(), "setup:channel width", "--channel-width-um");
  need(options.flow_rate_ul_s.has_value(), "setup:flow rate", "--flow-rate-ul-s");
  need(pixels == PixelUse::ignore || options.pixel_size_um, "imaging:pixel size", "--pixel-size-um");
  const bool has_viscosity = options.viscosity_mPas || recording.metadata().has(viscosity_key);
  need(has_viscosity || options.medium, "setup:medium", "--medium or --viscosity-mPas");
  need(has_viscosity || !options.temperature.empty() || !options.temperature_if_missing.empty() ||
           recording.has_scalar("temp"),
       "setup:temperature", "--temperature");
  if (missing.size() < (is_text ? 1U : 2U)) return;
  const bool is_one = missing.size() == 1;
  std::string way_out = is_one ? "give it as this option" : "give them as these options";
  if (is_text)
    way_out +=
        fmt::format(", or with the table (\"# setup:flow rate = 0.04\" in it, [setup] in {}; docs/text-recordings.md)",
                    one_line(fs::path(recording.file()).replace_extension(".toml").filename().string(), 100));
  refuse_path(recording.file(), fmt::format("the set-up is incomplete: {} {} missing; {}.", joined(missing, ", "),
                                            is_one ? "is" : "are", way_out));
}

ViscosityModel chosen_model(const MeasuringOptions& options) {
  const std::string name = options.viscosity_model.value_or("buyukurganci-2022");
  const auto model = viscosity_model_of_name(name);
  if (model) return *model;
  throw UserError(fmt::format("rheocyte: unknown viscosity model {}; there are buyukurganci-2022 and herold-2017.",
                              one_line(name, 60)));
}

Medium chosen_medium(const MeasuringOptions& options, const Recording& recording) {
  const auto name = options.medium ? options.medium : recording.metadata().text("setup:medium");
  const auto medium = name ? medium_of_name(*name) : std::nullopt;
  if (medium) return *medium;
  const std::string way_out =
      "give the viscosity with --viscosity-mPas, or one of CellCarrier, CellCarrierB, 0.83% MC-PBS, water with "
      "--medium";
  if (!name) refuse_path(recording.file(), fmt::format("setup:medium is missing; {}.", way_out));
  const std::string sentence =
      fmt::format("the medium \"{}\" has no known viscosity{}; {}.", one_line(*name, 60), near_medium(*name), way_out);
  if (options.medium) throw UserError("rheocyte: " + sentence);
  refuse_path(recording.file(), sentence);
}

void warn_about_temperature(ExtractSettings& settings) {
  if (settings.viscosity_varies() || settings.buffer->measured().contains(settings.temperature_C)) return;
  settings.warnings.push_back(fmt::format("{} degC is outside {}, for which the viscosity model {} was measured.",
                                          settings.temperature_C, settings.range_text(), settings.model_text()));
}

// Virtual recordings contain the viscosity itself.
std::optional<double> stored_viscosity(const MeasuringOptions& options, const Recording& recording) {
  const auto medium = options.medium ? options.medium : recording.metadata().text("setup:medium");
  if (options.medium || (medium && medium_of_name(*medium))) return std::nullopt;
  const auto stored = recording.metadata().number(viscosity_key);
  if (stored) check_viscosity(*stored, one_line(recording.file().string(), 300) + ": " + viscosity_key);
  return stored;
}

}  // namespace

std::string ExtractSettings::medium_text() const { return buffer ? std::string(name_of(buffer->medium())) : ""; }

std::string ExtractSettings::model_text() const { return buffer ? std::string(name_of(buffer->model())) : "given"; }

std::string ExtractSettings::temperature_text() const {
  switch (temperature_from) {
    case TemperatureSource::none: return "";
    case TemperatureSource::feature: return "of each event";
    case TemperatureSource::metadata: return fmt::format("{} degC (metadata)", temperature_C);
    default: return fmt::format("{} degC (given)", temperature_C);
  }
}

std::size_t ExtractSettings::viscosities(const Recording& recording, std::size_t first, std::span<double> mPas) const {
  if (!viscosity_varies()) {
    std::ranges::fill(mPas, conditions.flow.viscosity_mPas);
    return 0;
  }
  std::vector<double> temperatures(mPas.size());
  recording.read_scalar("temp", first, temperatures);
  for (double& celsius : temperatures)
    if (!is_possible_temperature(celsius)) celsius = temperature_of_others_C;
  buffer->viscosity(conditions.flow, temperatures, mPas);
  const auto is_outside = [range = buffer->measured()](double celsius) {
    return std::isfinite(celsius) && !range.contains(celsius);
  };
  return static_cast<std::size_t>(std::ranges::count_if(temperatures, is_outside));
}

std::string ExtractSettings::range_text() const {
  const auto range = buffer->measured();
  return fmt::format("{} to {} degC", range.lowest, range.highest);
}

std::vector<std::string> ExtractSettings::lines() const {
  std::vector<std::string> lines{fmt::format("channel width: {} um", conditions.flow.width_um),
                                 fmt::format("flow rate: {} ul/s", conditions.flow.rate_ul_s)};
  if (conditions.pixel_size_um > 0) lines.push_back(fmt::format("pixel size: {} um", conditions.pixel_size_um));
  if (buffer)
    lines.push_back(
        fmt::format("viscosity: {} by {}, temperature {}", medium_text(), model_text(), temperature_text()));
  if (!viscosity_varies()) lines.push_back(fmt::format("viscosity: {} mPa s", conditions.flow.viscosity_mPas));
  return lines;
}

double pixel_size_um(const Recording& recording, const std::optional<double>& given, const char* way_out) {
  return quantity(recording, given, {"imaging:pixel size", "um", way_out, measured_ranges().pixel_size_um});
}

ExtractSettings extract_settings(const MeasuringOptions& options, PixelUse pixels, const Recording& recording) {
  check_region(recording);
  check_set_up(options, pixels, recording);
  ExtractSettings settings;
  auto& conditions = settings.conditions;
  ChannelFlow& flow = conditions.flow;
  const MeasuredRanges ranges = measured_ranges();
  flow.width_um = quantity(recording, options.channel_width_um,
                           {"setup:channel width", "um", "--channel-width-um", ranges.channel_width_um});
  flow.rate_ul_s = quantity(recording, options.flow_rate_ul_s,
                            {"setup:flow rate", "ul/s", "--flow-rate-ul-s", ranges.flow_rate_ul_s});
  if (pixels != PixelUse::ignore)
    settings.pixel_size_um = conditions.pixel_size_um =
        pixel_size_um(recording, options.pixel_size_um,
                      pixels == PixelUse::fit ? "--pixel-size-um" : "--pixel-size-um, or give --no-pixelation");
  else
    settings.pixel_size_um =
        options.pixel_size_um.value_or(recording.metadata().number("imaging:pixel size").value_or(0));
  settings.warnings = contradictions(recording, options.flow_rate_ul_s ? 0 : flow.rate_ul_s, settings.pixel_size_um);
  conditions.correct_area = pixels == PixelUse::correct;
  const auto viscosity = options.viscosity_mPas ? options.viscosity_mPas : stored_viscosity(options, recording);
  if (viscosity) {
    flow.viscosity_mPas = *viscosity;
    return settings;
  }
  settings.buffer.emplace(chosen_medium(options, recording), chosen_model(options));
  const RecordingTemperature temperature = temperature_of(options, recording);
  settings.temperature_from = temperature.from;
  settings.temperature_C = temperature.celsius;
  settings.temperature_of_others_C = temperature.of_others;
  settings.warnings.insert(settings.warnings.end(), temperature.warnings.begin(), temperature.warnings.end());
  warn_about_temperature(settings);
  flow.exponent = settings.buffer->flow_exponent(temperature.celsius);
  if (!settings.viscosity_varies()) flow.viscosity_mPas = settings.buffer->viscosity(flow, settings.temperature_C);
  return settings;
}

}  // namespace rheocyte
