#include "report/features_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "events/companion_origin.h"
#include "events/direction_of_cells.h"
#include "events/event_pass.h"
#include "events/extract_settings.h"
#include "measurement/contour_tilt.h"
#include "measurement/event_outlines.h"
#include "measurement/shape_source.h"
#include "report/companion_writer.h"
#include "report/event_column.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t outlines_per_block = 4096;

/// The features from the outlines of a block of events.
struct OutlineBlock {
  std::span<const ContourFeatures> features;
  std::span<const OutlineTilt> tilt;
};

ColumnsOf<OutlineBlock> outline_columns() {
  ColumnsOf<OutlineBlock> columns;
  for (const OutlineFeature& feature : outline_features())
    columns.push_back({{.name = feature.name, .role = feature.name}, of_each(&OutlineBlock::features, feature.value)});
  for (const TiltFeature& feature : tilt_features())
    columns.push_back({{.name = feature.name, .sentence = feature.sentence, .role = feature.name, .rank = 1},
                       of_each(&OutlineBlock::tilt, feature.value)});
  return columns;
}

/// Reads the outlines of events, and gives their features.
class OutlineReader {
 public:
  OutlineReader(const Recording& recording, double pixel_size_um)
      : outlines_(recording, pixel_size_um),
        pixel_size_um_(pixel_size_um),
        direction_(direction_of_cells(outlines_, 1)) {}

  int direction() const { return direction_; }
  /// Of those read so far.
  std::size_t cut() const { return cut_; }

  void read(std::size_t first, std::span<ContourFeatures> features, std::span<OutlineTilt> tilt) {
    outlines_.each(first, features.size(), [&](std::size_t event, const PixelContour& contour) {
      const std::size_t i = event - first;
      const bool is_cut = outlines_.is_cut(contour);
      cut_ += is_cut;
      features[i] = measurer_.measure(is_cut ? PixelContour() : contour, pixel_size_um_);
      tilt[i] = {};
      if (!std::isfinite(features[i].area_um2)) return;
      tilt[i] = contour_tilt(contour, measurer_.hull(), direction_ < 0 ? -1 : 1, outlines_.picture());
    });
  }

 private:
  EventOutlines outlines_;
  double pixel_size_um_;
  int direction_;
  std::size_t cut_ = 0;
  ContourMeasurer measurer_;
};

}  // namespace

AtomicFile features_file(const fs::path& place) {
  return AtomicFile(place, [place] { check_companion("features", place); });
}

FeaturesSummary features_of_recording(const fs::path& file, const fs::path& place, const fs::path& scratch,
                                      std::optional<double> given_pixel_size_um, const TellProgress& on_progress) {
  Recording recording(file);
  check_same_recording(place, recording);
  ShapeSource::check_outlines(recording, "features of the shape are computed");
  const double size_um = pixel_size_um(recording, given_pixel_size_um, "--pixel-size-um");
  EventPass pass(recording, on_progress);
  OutlineReader outlines(recording, size_um);
  BlockValues<OutlineBlock> values(outline_columns());
  CompanionWriter companion(scratch, recording);
  companion.add(descriptions(values.columns()));
  companion.add_origin("features", fs::absolute(scratch).parent_path(),
                       {fmt::format("pixel size: {} um", size_um),
                        fmt::format("outlines: {}", recording.has_contours() ? "contours" : "masks"),
                        fmt::format("direction of the cells: {}", direction_text(outlines.direction()))});
  FeaturesSummary summary{recording.events(), 0, values.columns().size() - companion.missing().size()};
  std::vector<ContourFeatures> features;
  std::vector<OutlineTilt> tilt;
  pass.in_blocks(outlines_per_block, [&](std::size_t first, std::size_t count) {
    features.resize(count);
    tilt.resize(count);
    outlines.read(first, features, tilt);
    companion.write(first, values.of({features, tilt}));
    summary.with_outline += std::size_t(
        std::ranges::count_if(features, [](const ContourFeatures& f) { return std::isfinite(f.area_um2); }));
  });
  companion.close();
  summary.cut = outlines.cut();
  return summary;
}

}  // namespace rheocyte
