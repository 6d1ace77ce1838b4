// Where area and deformation of the events come from, and reading them block by block.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "measurement/recording.h"

namespace rheocyte {

/// Area and deformation of the convex hull of each event: the stored features, or what other data of the recording
/// give, in this order: area_um, area_cvx (in pixels), contours, masks; deform, circ (1 - deformation), contours,
/// masks.
class ShapeSource {
 public:
  /// `pixel_size_um`: used where areas are stored in pixels. UserError if the recording has nothing of the kind, or
  /// needs the pixel size and it is not positive.
  ShapeSource(const Recording& recording, double pixel_size_um);

  /// "area_um" or what stands in for it: "area_cvx", "contour", "mask".
  const std::string& area_from() const { return area_from_; }
  /// "deform", "circ", "contour", "mask".
  const std::string& deformation_from() const { return deformation_from_; }

  /// Events [first, first + areas_um2.size()), both spans equally long; NaN for events without a cell. UserError if
  /// the data are damaged.
  void read(std::size_t first, std::span<double> areas_um2, std::span<double> deformations);

  /// All features of the same events from their contours or masks.
  /// Only for recordings that have them: see has_outlines().
  void read_features(std::size_t first, std::span<ContourFeatures> features);
  static bool has_outlines(const Recording& recording) {
    return recording.has_contours() || recording.image_size("mask").has_value();
  }
  /// UserError for recordings without; `use` completes "..., from which".
  static void check_outlines(const Recording& recording, std::string_view use);

 private:
  void make_areas(std::span<double> pixels) const;
  void make_deformations(std::span<double> circularities) const;
  void features_from_masks(std::size_t first, std::span<ContourFeatures> features);

  const Recording& recording_;
  double pixel_size_um_;
  std::string area_from_, deformation_from_;
  ContourFinder finder_;
  ContourMeasurer measurer_;
  std::vector<ContourFeatures> features_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace rheocyte
