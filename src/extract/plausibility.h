// What no laboratory measures, and what in a recording contradicts itself: mostly units that were mistaken.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "case/channel_flow.h"
#include "measurement/recording.h"

namespace rheocyte {

/// Buffers have about the density of water.
inline constexpr double buffer_density_kg_per_m3 = 1000;
/// Up to here the liquid's inertia, which the tables do not hold, changes moduli by at most about 3 %.
inline constexpr double max_reynolds_number = 3;
/// Of the modulus, for each unit of the Reynolds number: between the 0.3 % of stiff and the 1.1 % of soft large cells
/// (docs/theory-extract.md, sec. "Own tables").
inline constexpr double modulus_per_reynolds = 0.007;

/// Water has 0.28 where it boils.
inline constexpr double min_viscosity_mPas = 0.2;

/// UserError of a recording whose outlines are so small (median radius) that errors of theirs are no noise any more.
void check_outline_noise(const std::filesystem::path& recording, double noise_um, double radius_um);

/// UserError if a viscosity (mPa s) that somebody has given is less than that of any liquid that cells live in. `name`
/// stands for its place in the message.
void check_viscosity(double mPas, const std::string& name);

/// Sentences, without the file's name, about flow rates that do not add up and areas that contradict the pixel size.
/// `rate_ul_s` and `pixel_size_um` are those that are used; 0 if they need no check.
std::vector<std::string> contradictions(const Recording& recording, double rate_ul_s, double pixel_size_um);

/// The sentence about events whose Reynolds number is too great; `greatest` of them all.
std::string inertia_text(std::size_t events, double greatest);
/// The same of events with these viscosities in a flow, whose own does not count; empty if there are none.
std::string inertia_text(const ChannelFlow& flow, std::span<const double> viscosity_mPas);

}  // namespace rheocyte
