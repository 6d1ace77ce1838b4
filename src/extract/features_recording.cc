#include "extract/features_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "extract/companion_origin.h"
#include "extract/event_pass.h"
#include "extract/extract_settings.h"
#include "measurement/shape_source.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t masks_at_a_time = 4096;

}  // namespace

WholeFile features_file(const fs::path& place) {
  return WholeFile(place, [place] { check_companion(place); });
}

FeaturesSummary features_of_recording(const fs::path& file, const fs::path& place, const fs::path& scratch,
                                      std::optional<double> given_pixel_size_um, const TellProgress& on_progress) {
  Recording recording(file);
  check_same_recording(place, recording);
  ShapeSource::check_outlines(recording, "features of the shape are computed");
  const double size_um = pixel_size_um(recording, given_pixel_size_um, "--pixel-size-um");
  EventPass pass(recording, on_progress);
  ShapeSource shapes(recording, size_um);
  CompanionFile companion(scratch, recording, program());
  for (const OutlineFeature& feature : outline_features()) companion.add_feature(feature.name);
  add_origin(companion, "features", recording, fs::absolute(scratch).parent_path(),
             {fmt::format("pixel size: {} um", size_um),
              fmt::format("outlines: {}", recording.has_contours() ? "contours" : "masks")});
  FeaturesSummary summary{recording.events()};
  std::vector<ContourFeatures> features;
  std::vector<double> values;
  pass.in_blocks(masks_at_a_time, [&](std::size_t first, std::size_t count) {
    features.resize(count);
    values.resize(count);
    shapes.read_features(first, features);
    for (const OutlineFeature& feature : outline_features()) {
      std::ranges::transform(features, values.begin(), feature.value);
      companion.write(feature.name, first, values);
    }
    summary.with_outline += std::size_t(
        std::ranges::count_if(features, [](const ContourFeatures& f) { return std::isfinite(f.area_um2); }));
  });
  companion.close();
  return summary;
}

}  // namespace rheocyte
