// What no laboratory measures, and what in a recording contradicts itself: mostly units that were mistaken.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "case/channel_flow.h"
#include "measurement/recording.h"
#include "shape/outline_shape.h"

namespace rheocyte {

/// Buffers have about the density of water.
inline constexpr double buffer_density_kg_per_m3 = 1000;
/// Of a flow whose viscosity were 1 mPa s; that of an event is this over its viscosity (mPa s).
inline double reynolds_at_1_mPas(ChannelFlow flow) {
  flow.viscosity_mPas = 1;
  return reynolds_number(buffer_density_kg_per_m3, flow);
}
/// Up to here the liquid's inertia, which the tables do not hold, changes moduli by at most about 3 %.
inline constexpr double max_reynolds_number = 3;
/// Of the modulus, for each unit of the Reynolds number: between the 0.3 % of stiff and the 1.1 % of soft large cells
/// (docs/theory-extract.md, sec. "Own tables").
inline constexpr double modulus_per_reynolds = 0.007;

/// Red cells rest in a long shape, and are small: a disc of 8 um has 50 um2. Other cells are as long where they are
/// soft.
inline constexpr double min_inertia_ratio_of_red_cells = 2, max_area_of_red_cells_um2 = 60;
inline bool is_red_cell(double inertia_ratio, double area_um2) {
  return inertia_ratio > min_inertia_ratio_of_red_cells && area_um2 < max_area_of_red_cells_um2;
}

/// Water has 0.28 where it boils.
inline constexpr double min_viscosity_mPas = 0.2;

/// The outlines of a recording: the median of each feature, and c7 of all events, if it is known.
struct SeenOutlines {
  ShapeVector median;
  std::span<const double> modes_7;
};
/// UserError of a recording whose outlines are so small that such errors of theirs are no noise any more, or whose c7
/// scatters by much less than these errors alone would make it.
void check_outline_noise(const std::filesystem::path& recording, double noise_um, double pixel_size_um,
                         const SeenOutlines& outlines);

/// UserError if a viscosity (mPa s) that somebody has given is less than that of any liquid that cells live in. `name`
/// stands for its place in the message.
void check_viscosity(double mPas, const std::string& name);

/// Sentences, without the file's name, about flow rates that do not add up and areas that contradict the pixel size.
/// `rate_ul_s` and `pixel_size_um` are those that are used; 0 if they need no check.
std::vector<std::string> contradictions(const Recording& recording, double rate_ul_s, double pixel_size_um);

}  // namespace rheocyte
