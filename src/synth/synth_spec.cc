#include "synth/synth_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analytic/small_deformation.h"
#include "case/key_reading.h"
#include "case/user_error.h"
#include "measurement/viscosity.h"
#include "synth/synth_keys.h"

namespace rheocyte {

namespace {

void check_tension(const SynthSpec& spec, const KeyReading& keys) {
  constexpr std::string_view key = "cell.cortex.tension_ratio";
  if (!keys.has(key) || spec.kind == CellKind::combined) return;
  if (!spec.table.empty()) keys.refuse_stated(key, "has no effect, because shapes.table is given; remove one of them");
  if (spec.tension_ratio->deviation > 0)
    keys.refuse(key, fmt::format("{} is one number for all shells; only combined cells have a spread of it.", key));
}

void check_medium(const SynthSpec& spec, const KeyReading& keys) {
  if (spec.viscosity_mPas) return;
  constexpr std::string_view key = "flow.medium";
  const auto medium = medium_of_name(spec.medium);
  if (!medium)
    keys.refuse_stated(key, fmt::format("has no known viscosity{}; it can be CellCarrier, CellCarrierB, 0.83% MC-PBS "
                                        "or water, or give flow.viscosity_mPas",
                                        near_medium(spec.medium)));
  try {
    const Buffer check(*medium, spec.viscosity_model);
  } catch (const UserError& error) {
    keys.refuse(key, error.what());
  }
}

// Digits where `pattern` has a 0, its own characters elsewhere.
void check_pattern(const std::string& text, std::string_view pattern, std::string_view key, const KeyReading& keys) {
  const auto fits = [](char wanted, char is) { return wanted == '0' ? is >= '0' && is <= '9' : is == wanted; };
  if (text.size() != pattern.size() || !std::ranges::equal(pattern, text, fits))
    keys.refuse_stated(key, fmt::format("must have the form {}", find_key(synth_keys(), key)->sentence));
}

void check_shapes(SynthSpec& spec, const KeyReading& keys) {
  constexpr std::string_view viscosity = "cell.viscosity_mPas";
  if (keys.has(viscosity) && !spec.is_on_its_way())
    keys.refuse(viscosity, fmt::format("{} has no effect on a stationary shape; remove it, or give "
                                       "recording.places_um.",
                                       viscosity));
  if (!spec.table.empty()) return;
  if (spec.is_on_its_way() && spec.analytical)
    keys.refuse("recording.places_um",
                "recording.places_um and shapes.model = \"analytical\" contradict each other: the analytical model has "
                "stationary cells only.");
  if (spec.kind == CellKind::combined && spec.analytical)
    keys.refuse("shapes.model",
                "cell.kind = \"combined\" and shapes.model = \"analytical\" contradict each other: the analytical "
                "model has no such cells.");
  if (spec.kind == CellKind::shell && !spec.analytical)
    keys.refuse("shapes.table",
                "cell.kind = \"shell\" needs shapes.table, the folder of a table of shells, or shapes.model = "
                "\"analytical\"; no table of shells comes with the program.");
  if (spec.analytical && spec.max_deformation == 0)
    spec.max_deformation = spec.kind == CellKind::solid ? max_solid_deformation : max_shell_deformation;
}

}  // namespace

ImageSize SynthSpec::image_size() const {
  constexpr double beyond_the_walls_um = 3;
  const double needed = (channel_width_um + 2 * beyond_the_walls_um) / pixel_size_um;
  const double height = height_px > 0 ? height_px : 2 * std::ceil(0.5 * needed);
  return {static_cast<std::size_t>(width_px), static_cast<std::size_t>(height)};
}

SynthSpec parse_synth_spec(std::string_view text, const std::string& name, std::span<const std::string> settings) {
  KeyReading keys(key_list(synth_keys()), given_keys(text, name, settings, specification("synth")), name, "synth");
  keys.complete();
  SynthSpec spec;
  keys.fill(spec, synth_keys());
  check_tension(spec, keys);
  check_medium(spec, keys);
  check_pattern(spec.date, "0000-00-00", "recording.date", keys);
  check_pattern(spec.time, "00:00:00", "recording.time", keys);
  if (spec.image_size().height > 4000)
    keys.refuse("recording.pixel_size_um",
                fmt::format("the channel is {} pixels wide; give a larger recording.pixel_size_um.",
                            std::floor(spec.channel_width_um / spec.pixel_size_um)));
  check_shapes(spec, keys);
  return spec;
}

}  // namespace rheocyte
