// The masks of a recording in memory, with the settings under which they were measured, for the C interface.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "case/user_error.h"
#include "instrument/rheocyte_cell.h"
#include "measurement/recording.h"
#include "measurement/viscosity.h"

namespace rheocyte {

struct MeasuredMasks {
  ImageSize size;
  std::size_t count = 0;
  std::vector<std::uint8_t> pixels;
  std::string medium;
  rheocyte_cell_settings settings{};

  std::uint32_t width() const { return std::uint32_t(size.width); }
  std::uint32_t height() const { return std::uint32_t(size.height); }
  /// Again from the first one after the last one.
  const std::uint8_t* mask(std::size_t i) const { return pixels.data() + i % count * size.pixels(); }

  rheocyte_cell_setup* open() const {
    rheocyte_cell_settings used = settings;
    used.medium = medium.empty() ? nullptr : medium.c_str();
    rheocyte_cell_setup* set_up = nullptr;
    std::array<char, 500> message{};
    if (rheocyte_cell_open(RHEOCYTE_CELL_ABI, &used, &set_up, message.data(), message.size()) != RHEOCYTE_CELL_OK)
      throw UserError(message.data());
    return set_up;
  }
};

inline MeasuredMasks read_masks(const std::filesystem::path& file) {
  const Recording recording(file);
  const auto size = recording.image_size("mask");
  if (!size) throw UserError(file.string() + ": has no masks.");
  MeasuredMasks masks;
  masks.size = *size;
  masks.count = recording.events();
  masks.pixels.resize(masks.count * size->pixels());
  recording.read_images("mask", 0, masks.count, masks.pixels);
  const Metadata& metadata = recording.metadata();
  masks.medium = metadata.text("setup:medium").value_or("");
  rheocyte_cell_default_settings(&masks.settings);
  const auto number = [&](const char* key) { return metadata.number(key).value_or(masks.settings.temperature_C); };
  masks.settings.viscosity_mPas = number(viscosity_key);
  if (!medium_of_name(masks.medium)) masks.medium.clear();
  masks.settings.channel_width_um = number("setup:channel width");
  masks.settings.flow_rate_ul_s = number("setup:flow rate");
  masks.settings.pixel_size_um = number("imaging:pixel size");
  masks.settings.temperature_C = metadata.number("setup:temperature").value_or(23);
  return masks;
}

}  // namespace rheocyte
