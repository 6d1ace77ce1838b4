#include "app/moduli_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "app/build_info.h"
#include "app/extract_settings.h"
#include "case/user_error.h"
#include "infer/pixel_law.h"
#include "measurement/contour_from_mask.h"

namespace rheocyte {

namespace {

constexpr std::size_t fewest_points = 12;  // of an outline that is a cell
constexpr std::size_t events_between_words = 256;

/// The outlines of a recording, event by event.
class Outlines {
 public:
  Outlines(const Recording& recording, double pixel_um) : recording_(recording), pixel_um_(pixel_um) {
    if (!recording.has_contours()) size_ = recording.image_size("mask");
    if (!recording.has_contours() && !size_)
      throw UserError(fmt::format("{}: has neither contours nor masks; several moduli need the shape of each cell.",
                                  one_line(recording.file().string(), 300)));
    if (!(pixel_um > 0))
      throw UserError(
          fmt::format("{}: the pixel size is missing; give --pixel-size.", one_line(recording.file().string(), 300)));
    if (size_) block_ = recording.image_rows_per_chunk("mask");
  }

  /// NaN where there is no cell.
  ShapeVector features(std::size_t event) {
    const PixelContour contour = outline(event);
    if (contour.size() < fewest_points) return ShapeVector::Constant(std::numeric_limits<double>::quiet_NaN());
    Eigen::MatrixX2d polygon(Eigen::Index(contour.size()), 2);
    for (Eigen::Index i = 0; i < polygon.rows(); ++i) {
      const PixelPoint& point = contour[std::size_t(i)];
      polygon.row(i) << pixel_um_ * point.x, pixel_um_ * point.y;
    }
    return shape_vector(outline_shape(polygon));
  }

 private:
  PixelContour outline(std::size_t event) {
    if (!size_) return recording_.read_contour(event);
    if (event < first_ || event >= first_ + count_) {
      first_ = event - event % block_;
      count_ = std::min(block_, recording_.events() - first_);
      pixels_.resize(count_ * size_->pixels());
      recording_.read_images("mask", first_, count_, pixels_);
    }
    return finder_.contour_of(
        {*size_, std::span(pixels_).subspan((event - first_) * size_->pixels(), size_->pixels())});
  }

  const Recording& recording_;
  double pixel_um_;
  std::optional<ImageSize> size_;
  std::size_t block_ = 1, first_ = 0, count_ = 0;  ///< events whose masks are at hand
  std::vector<std::uint8_t> pixels_;
  ContourFinder finder_;
};

/// Of each event, in mPa s.
std::vector<double> viscosities(const Recording& recording, const ExtractSettings& settings) {
  std::vector<double> viscosity(recording.events(), settings.viscosity_mPas);
  if (!settings.viscosity_varies()) return viscosity;
  std::vector<double> temperature(recording.events());
  recording.read_scalar("temp", 0, temperature);
  const auto& conditions = settings.conditions;
  settings.buffer->viscosity({conditions.channel_width_um, conditions.flow_rate_ul_s}, temperature, viscosity);
  return viscosity;
}

std::string header(const Recording& recording, const ModuliOptions& options) {
  return fmt::format(
      "# rheocyte {} moduli\n# recording: {}\n# table: {}\n# by {}{}\n"
      "event\tarea_um2\tdeformation\tyoung_modulus_kPa\tyoung_modulus_error_kPa\tcortex_modulus_mN_per_m\t"
      "cortex_modulus_error_mN_per_m\ttension_mN_per_m\ttension_error_mN_per_m\tstiffness_kPa\tstiffness_error_kPa\t"
      "chi_squared\tstatus\n",
      version, recording.file().string(), options.measuring.table,
      options.only_figure ? "area, deformation and Lambda1/Lambda2" : "area and modes 2 .. 6 of the contour",
      options.fit_tension ? "; the tension is fitted" : "; the tension is that of the table");
}

std::string line(std::size_t event, const ShapeVector& seen, const ModuliEstimate& e) {
  std::string text = fmt::format("{}\t{:.6g}\t{:.6g}", event + 1, std::exp(seen(0)), seen(1));
  for (const Modulus m : {Modulus::young, Modulus::cortex, Modulus::tension})
    text += fmt::format("\t{:.6g}\t{:.3g}", e.value(m), e.error(m));
  return text + fmt::format("\t{:.6g}\t{:.3g}\t{:.4g}\t{}\n", e.stiffness_kPa, e.stiffness_error_kPa, e.chi_squared,
                            name_of(e.status));
}

}  // namespace

std::string moduli_text(const std::filesystem::path& file, const ModuliOptions& options,
                        const CombinedInterpolation& table, const FlowConditions& simulated,
                        const TellProgress& tell_progress) {
  const Recording recording(file);
  const ExtractSettings settings = extract_settings(options.measuring, recording);
  Outlines outlines(recording, settings.pixel_size_um);
  const double width = settings.conditions.channel_width_um;
  const PixelLaw law(table, settings.pixel_size_um * simulated.channel_width_um / width);
  const SeveralModuli moduli(table, simulated,
                             {options.only_figure ? features_of_figure() : features_of_contour(), options.fit_tension,
                              table.tension_ratios().front()});
  const auto viscosity = viscosities(recording, settings);
  std::string text = header(recording, options);
  for (std::size_t i = 0; i < recording.events(); ++i) {
    const ShapeVector seen = outlines.features(i);
    const FlowConditions conditions{width, settings.conditions.flow_rate_ul_s, viscosity[i]};
    text += line(i, seen, fit_pixels(moduli, law, seen, conditions));
    if (i % events_between_words == 0) tell_progress(double(i) / double(recording.events()));
  }
  return text;
}

}  // namespace rheocyte
