// Set-ups and workers of the C interface that close themselves.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "rheocyte_cell.h"
#include "store/build_info.h"

namespace rheocyte::test {

/// The usual one: 20 um, 0.04 ul/s, 0.34 um, a viscosity of 8 mPa s, and the tables of the sources.
inline rheocyte_cell_settings usual_settings(double axial_tension_Pa = NAN) {
  rheocyte_cell_settings settings;
  rheocyte_cell_default_settings(&settings);
  settings.tables_folder = data_folder;
  settings.viscosity_mPas = 8;
  settings.channel_width_um = 20;
  settings.flow_rate_ul_s = 0.04;
  settings.pixel_size_um = 0.34;
  settings.axial_tension_Pa = axial_tension_Pa;
  return settings;
}

/// A set-up with one worker.
class Opened {
 public:
  explicit Opened(const rheocyte_cell_settings& settings, std::uint32_t width = 250, std::uint32_t height = 80,
                  std::uint32_t remembered = 0) {
    std::array<char, 500> message{};
    EXPECT_EQ(rheocyte_cell_open(RHEOCYTE_CELL_ABI, &settings, &set_up, message.data(), message.size()), 0)
        << message.data();
    EXPECT_EQ(rheocyte_cell_open_worker(set_up, width, height, remembered, &worker), 0);
  }
  ~Opened() {
    EXPECT_EQ(rheocyte_cell_close_worker(worker), 0);
    EXPECT_EQ(rheocyte_cell_close(set_up), 0);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  rheocyte_cell_result from_features(double area_um2, double deformation, double inertia_ratio = NAN) const {
    rheocyte_cell_result result{};
    EXPECT_EQ(rheocyte_cell_from_features(worker, &area_um2, &deformation, &inertia_ratio, 1, &result), 0);
    return result;
  }

  rheocyte_cell_setup* set_up = nullptr;
  rheocyte_cell_worker* worker = nullptr;
};

/// A mask of 250 x 80 pixels with an ellipse about (x, y).
inline std::vector<std::uint8_t> ellipse(double x = 125, double y = 40, double length = 21, double height = 18) {
  std::vector<std::uint8_t> mask(std::size_t{250} * 80);
  for (int row = 0; row < 80; ++row)
    for (int column = 0; column < 250; ++column)
      if (std::hypot((column - x) / length, (row - y) / height) <= 1) mask[std::size_t(row * 250 + column)] = 255;
  return mask;
}

}  // namespace rheocyte::test
