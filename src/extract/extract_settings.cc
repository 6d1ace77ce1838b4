#include "extract/extract_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "case/user_error.h"

namespace rheocyte {

namespace {

[[noreturn]] void refuse(const Recording& recording, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", one_line(recording.file().string(), 300), reason));
}

double quantity(const Recording& recording, const std::optional<double>& given, const std::string& key,
                const std::string& way_out) {
  if (given) return *given;
  const auto stored = recording.metadata().number(key);
  if (stored && *stored > 0 && std::isfinite(*stored)) return *stored;
  refuse(recording, fmt::format("{} {}; give it with {}.", key,
                                recording.metadata().has(key) ? "is not a positive number" : "is missing", way_out));
}

void check_region(const Recording& recording) {
  std::string region = recording.metadata().text("setup:chip region").value_or("channel");
  std::ranges::transform(region, region.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (region != "channel")
    refuse(recording, fmt::format("was recorded in the {}, where cells are not deformed by the channel; moduli exist "
                                  "only for recordings with setup:chip region \"channel\".",
                                  one_line(region, 40)));
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
  if (!name) refuse(recording, fmt::format("setup:medium is missing; {}.", way_out));
  const std::string sentence =
      fmt::format("the medium \"{}\" has no known viscosity; {}.", one_line(*name, 60), way_out);
  if (options.medium) throw UserError("rheocyte: " + sentence);
  refuse(recording, sentence);
}

void choose_temperature(const MeasuringOptions& options, const Recording& recording, ExtractSettings& settings) {
  const std::string& wish = options.temperature;
  double value = 0;
  const auto [end, error] = std::from_chars(wish.data(), wish.data() + wish.size(), value);
  if (!wish.empty() && error == std::errc{} && end == wish.data() + wish.size() && std::isfinite(value)) {
    settings.temperature_from = TemperatureSource::given;
    settings.temperature_C = value;
    return;
  }
  if (!wish.empty() && wish != "feature" && wish != "metadata")
    throw UserError(
        fmt::format("rheocyte: --temperature {}: give degrees Celsius, feature or metadata.", one_line(wish, 60)));
  const bool has_feature = recording.has_scalar("temp");
  if (wish == "feature" && !has_feature)
    refuse(recording, "has no temperature of each event; give --temperature in degrees Celsius.");
  if (has_feature && wish != "metadata") {
    settings.temperature_from = TemperatureSource::feature;
    return;
  }
  const auto stored = recording.metadata().number("setup:temperature");
  if (!stored || !std::isfinite(*stored))
    refuse(recording,
           "holds no temperature, on which the viscosity depends; give --temperature in degrees Celsius, or the "
           "viscosity with --viscosity-mPas.");
  settings.temperature_from = TemperatureSource::metadata;
  settings.temperature_C = *stored;
}

std::string outside(const ExtractSettings& settings) {
  const auto range = settings.buffer->measured();
  return fmt::format("outside {} to {} degC, for which the viscosity model {} was measured.", range.lowest,
                     range.highest, settings.model_text());
}

void warn_about_temperature(ExtractSettings& settings) {
  if (settings.viscosity_varies() || settings.buffer->measured().contains(settings.temperature_C)) return;
  settings.warnings.push_back(fmt::format("{} degC is {}", settings.temperature_C, outside(settings)));
}

// The one of the recording as a whole; a degree changes the exponents of methyl cellulose by 0.002.
double usual_temperature_C(const ExtractSettings& settings, const Recording& recording) {
  constexpr double laboratory_C = 23;
  if (!settings.viscosity_varies()) return settings.temperature_C;
  const double stored = recording.metadata().number("setup:temperature").value_or(laboratory_C);
  return std::isfinite(stored) ? stored : laboratory_C;
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
  buffer->viscosity(conditions.flow, temperatures, mPas);
  const auto is_outside = [range = buffer->measured()](double celsius) {
    return std::isfinite(celsius) && !range.contains(celsius);
  };
  return static_cast<std::size_t>(std::ranges::count_if(temperatures, is_outside));
}

std::string ExtractSettings::outside_temperature_text(std::size_t events) const {
  return fmt::format("{} events have temperatures {}", events, outside(*this));
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

ExtractSettings extract_settings(const MeasuringOptions& options, PixelUse pixels, const Recording& recording) {
  check_region(recording);
  ExtractSettings settings;
  auto& conditions = settings.conditions;
  ChannelFlow& flow = conditions.flow;
  flow.width_um = quantity(recording, options.channel_width_um, "setup:channel width", "--channel-width-um");
  flow.rate_ul_s = quantity(recording, options.flow_rate_ul_s, "setup:flow rate", "--flow-rate-ul-s");
  if (pixels != PixelUse::ignore)
    settings.pixel_size_um = conditions.pixel_size_um =
        quantity(recording, options.pixel_size_um, "imaging:pixel size",
                 pixels == PixelUse::fit ? "--pixel-size-um" : "--pixel-size-um, or give --no-pixelation");
  else
    settings.pixel_size_um =
        options.pixel_size_um.value_or(recording.metadata().number("imaging:pixel size").value_or(0));
  conditions.correct_area = pixels == PixelUse::correct;
  if (options.viscosity_mPas) {
    flow.viscosity_mPas = *options.viscosity_mPas;
    return settings;
  }
  settings.buffer.emplace(chosen_medium(options, recording), chosen_model(options));
  choose_temperature(options, recording, settings);
  warn_about_temperature(settings);
  flow.exponent = settings.buffer->flow_exponent(usual_temperature_C(settings, recording));
  if (!settings.viscosity_varies()) flow.viscosity_mPas = settings.buffer->viscosity(flow, settings.temperature_C);
  return settings;
}

}  // namespace rheocyte
