#include "measurement/shape_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/joined.h"
#include "case/refuse_path.h"
#include "case/user_error.h"
#include "measurement/text_table.h"
#include "numeric/quantile.h"

namespace rheocyte {

namespace {

constexpr std::size_t max_block_bytes = 32U << 20U;  // of masks in memory at a time

std::string first_there(const Recording& recording, const std::string& feature, const std::string& stand_in) {
  if (recording.has_scalar(feature)) return feature;
  if (recording.has_scalar(stand_in)) return stand_in;
  if (recording.has_contours()) return "contour";
  return recording.image_size("mask") ? "mask" : "";
}

/// UserError if most values are more than deformations and circularities can be.
void refuse_per_cent(const Recording& recording, const std::string& feature, std::span<const double> values) {
  const double greatest = feature == "circ" ? 2 : 1;  // circularities of few pixels may exceed 1
  const auto impossible = std::ranges::count_if(values, [&](double value) { return value > greatest; });
  if (impossible == 0 || 2 * std::size_t(impossible) < values.size()) return;
  std::vector<double> sorted(values.begin(), values.end());
  std::erase_if(sorted, [](double value) { return std::isnan(value); });
  refuse_path(recording.file(),
              fmt::format("{} is {:.3g} at the median, and cannot exceed 1: is it in per cent? Store it as a fraction.",
                          feature, quantile(sorted, 0.5)));
}

[[noreturn]] void refuse_table(const Recording& table, const std::string& missing) {
  std::string columns = joined(table.scalar_names(), ", ");
  for (const auto& remark : table.remarks()) columns += "; " + remark.substr(0, remark.find_last_not_of('.') + 1);
  refuse_path(table.file(), fmt::format("has no column {}; its columns are {}. Name columns as dclab does: area_um is "
                                        "in um2, deform is 1 - circularity.",
                                        missing, columns));
}

bool from_outline(const std::string& source) { return source == "contour" || source == "mask"; }

}  // namespace

ShapeSource::ShapeSource(const Recording& recording, double pixel_size_um)
    : recording_(recording),
      pixel_size_um_(pixel_size_um),
      area_from_(first_there(recording, "area_um", "area_cvx")),
      deformation_from_(first_there(recording, "deform", "circ")) {
  const auto name = one_line(recording.file().string(), 300);
  if (area_from_.empty() || deformation_from_.empty()) {
    const char* const missing = area_from_.empty() ? "area_um" : "deform";
    if (is_text_table(recording.file())) refuse_table(recording, missing);
    std::string remarks;  // perhaps they lie where they were not found
    for (const auto& remark : recording.remarks()) remarks += "; " + remark;
    throw UserError(fmt::format("{}: has neither {} nor contours nor masks, so that no modulus can be determined{}",
                                name, missing, remarks.empty() ? "." : remarks));
  }
  if (area_from_ != "area_um" && !(pixel_size_um > 0))
    throw UserError(
        fmt::format("{}: its areas are in pixels, and the pixel size is missing; give it with --pixel-size-um.", name));
}

void ShapeSource::check_outlines(const Recording& recording, std::string_view use) {
  if (!has_outlines(recording))
    refuse_path(recording.file(), fmt::format("has neither contours nor masks, from which {}.", use));
}

void ShapeSource::read(std::size_t first, std::span<double> areas_um2, std::span<double> deformations) {
  if (from_outline(area_from_) || from_outline(deformation_from_)) {
    features_.resize(areas_um2.size());
    read_features(first, features_);
  }
  if (from_outline(area_from_)) {
    std::ranges::transform(features_, areas_um2.begin(), &ContourFeatures::area_um2);
  } else {
    recording_.read_scalar(area_from_, first, areas_um2);
    if (area_from_ == "area_cvx") make_areas(areas_um2);
  }
  if (from_outline(deformation_from_)) {
    std::ranges::transform(features_, deformations.begin(), &ContourFeatures::deformation);
  } else {
    recording_.read_scalar(deformation_from_, first, deformations);
    refuse_per_cent(recording_, deformation_from_, deformations);
    if (deformation_from_ == "circ") make_deformations(deformations);
  }
}

// Single precision stays what it is, as in the programs that would have stored the feature: at the steep edge of a
// table its rounding is seen in the sixth digit of the modulus.
void ShapeSource::make_areas(std::span<double> pixels) const {
  const double pixel_um2 = pixel_size_um_ * pixel_size_um_;
  const bool single = recording_.is_single_precision("area_cvx");
  for (double& area : pixels)
    area = single ? static_cast<double>(static_cast<float>(area) * static_cast<float>(pixel_um2)) : area * pixel_um2;
}

void ShapeSource::make_deformations(std::span<double> circularities) const {
  const bool single = recording_.is_single_precision("circ");
  for (double& value : circularities) value = single ? static_cast<double>(1 - static_cast<float>(value)) : 1 - value;
}

void ShapeSource::read_features(std::size_t first, std::span<ContourFeatures> features) {
  if (!recording_.has_contours()) return features_from_masks(first, features);
  for (std::size_t i = 0; i < features.size(); ++i)
    features[i] = measurer_.measure(recording_.read_contour(first + i), pixel_size_um_);
}

void ShapeSource::features_from_masks(std::size_t first, std::span<ContourFeatures> features) {
  const ImageSize size = recording_.image_size("mask").value_or(ImageSize{});
  // Whole chunks of the file, but not more memory than the limit.
  const std::size_t chunk = recording_.image_rows_per_chunk("mask");
  const std::size_t fitting = std::max<std::size_t>(max_block_bytes / std::max<std::size_t>(size.pixels(), 1), 1);
  const std::size_t step = fitting > chunk ? fitting / chunk * chunk : fitting;
  for (std::size_t done = 0; done < features.size();) {
    const std::size_t to_boundary = step - (first + done) % step;
    const std::size_t count = std::min(to_boundary, features.size() - done);
    pixels_.resize(count * size.pixels());
    recording_.read_images("mask", first + done, count, pixels_);
    for (std::size_t i = 0; i < count; ++i) {
      const Mask mask{size, std::span(pixels_).subspan(i * size.pixels(), size.pixels())};
      features[done + i] = measurer_.measure(finder_.contour_of(mask), pixel_size_um_);
    }
    done += count;
  }
}

}  // namespace rheocyte
