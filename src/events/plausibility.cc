#include "events/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "infer/rendered_errors.h"
#include "measurement/shape_in_pixels.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr double deviations_in_90_percent = 3.29;  ///< of a normal distribution
constexpr double rate_tolerance = 0.01, area_tolerance = 0.02;
constexpr std::size_t events_looked_at = 4096;  // events

void add_rate(const Recording& recording, double rate_ul_s, std::vector<std::string>& sentences) {
  const auto sample = recording.metadata().number("setup:flow rate sample"),
             sheath = recording.metadata().number("setup:flow rate sheath");
  if (!sample || !sheath || !(*sample >= 0 && *sheath >= 0 && *sample + *sheath > 0)) return;
  const double sum = *sample + *sheath;
  if (std::abs(sum / rate_ul_s - 1) <= rate_tolerance) return;
  sentences.push_back(
      fmt::format("setup:flow rate is {:g} ul/s, but sample and sheath together are {:g} ul/s; moduli are proportional "
                  "to the flow rate, and {:g} ul/s was used (--flow-rate-ul-s sets another value).",
                  rate_ul_s, sum, rate_ul_s));
}

// Areas are stored in um^2 and in pixels: their ratio is the area of a pixel.
void add_pixel(const Recording& recording, double pixel_size_um, std::vector<std::string>& sentences) {
  if (!recording.has_scalar("area_um") || !recording.has_scalar("area_cvx")) return;
  const std::size_t count = std::min(events_looked_at, recording.events());
  std::vector<double> um2(count), pixels(count), ratios;
  recording.read_scalar("area_um", 0, um2);
  recording.read_scalar("area_cvx", 0, pixels);
  for (std::size_t i = 0; i < count; ++i)
    if (um2[i] > 0 && pixels[i] > 0) ratios.push_back(um2[i] / pixels[i]);
  if (ratios.empty()) return;
  const double implied = median_of(ratios);
  if (std::abs(implied / (pixel_size_um * pixel_size_um) - 1) <= area_tolerance) return;
  sentences.push_back(
      fmt::format("the pixel size is {:g} um, but areas in um^2 and in pixels (area_um, area_cvx) belong to pixels of "
                  "{:.3g} um.",
                  pixel_size_um, std::sqrt(implied)));
}

}  // namespace

namespace {

/// Standard deviation over pictures of one cell with such errors of the outline.
double scatter_of_mode_7(const ShapeVector& cell, double noise_um, double pixel_size_um) {
  constexpr int pictures = 400, mode_7 = feature_of_mode(7);
  CellRandom random(1, 0, Purpose::picture);
  const ShapeErrors errors =
      errors_in_pixels(outline_of(cell), pixel_size_um, pictures, random, OutlineNoise{.deviation = noise_um});
  return std::sqrt(errors.covariance(mode_7, mode_7));
}

}  // namespace

void check_viscosity(double mPas, const std::string& name) {
  if (mPas >= min_viscosity_mPas) return;
  throw UserError(
      fmt::format("{}: {:g} mPa s is less than the viscosity of any liquid that cells live in (water at 37 degC has "
                  "0.69 mPa s); {:g} Pa s are {:g} mPa s.",
                  name, mPas, mPas, 1000 * mPas));
}

void check_outline_noise(const std::filesystem::path& recording, double noise_um, double pixel_size_um,
                         const SeenOutlines& outlines) {
  constexpr double most_of_radius = 0.1;  // displacements that are not small against the radius are no noise
  constexpr double most_of_scatter = 1.5;
  constexpr std::size_t fewest_that_scatter = 20;
  const double radius_um = std::exp(outlines.median(int(ShapeFeature::area_um2)) / 2) * std::numbers::inv_sqrtpi;
  if (noise_um > most_of_radius * radius_um)
    refuse_path(recording, fmt::format("its outlines have a median radius of {:.3g} um, and --outline-noise-um {:g} is "
                                       "more than a tenth of it; give the value measured with beads, in um.",
                                       radius_um, noise_um));
  if (noise_um == 0 || outlines.modes_7.size() < fewest_that_scatter) return;
  const double scatter = central_width(outlines.modes_7) / deviations_in_90_percent;
  const double of_noise = scatter_of_mode_7(outlines.median, noise_um, pixel_size_um);
  if (of_noise > most_of_scatter * scatter)
    refuse_path(
        recording,
        fmt::format("--outline-noise-um {:g} is too large: it would make the mode c7 of equal cells scatter by {:.2g}, "
                    "and that of the events scatters by {:.2g}; give the value measured with beads, in um.",
                    noise_um, of_noise, scatter));
}

std::vector<std::string> contradictions(const Recording& recording, double rate_ul_s, double pixel_size_um) {
  std::vector<std::string> sentences;
  if (rate_ul_s > 0) add_rate(recording, rate_ul_s, sentences);
  if (pixel_size_um > 0) add_pixel(recording, pixel_size_um, sentences);
  return sentences;
}

}  // namespace rheocyte
