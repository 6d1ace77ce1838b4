// Features of the shape of all events of a recording, from its contours or masks, as a companion.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>

#include "measurement/contour_features.h"
#include "store/atomic_file.h"
#include "store/progress.h"

namespace rheocyte {

struct FeaturesSummary {
  std::size_t events = 0, with_outline = 0, features = 0;
  std::size_t cut = 0;  ///< by the edge of the picture: they have no features
};

/// The companion of a recording while it is written; UserError if a file stands there that is not ours.
AtomicFile features_file(const std::filesystem::path& place);

/// Computes all of outline_features(), and of tilt_features() as far as userdef0 to userdef9 are free, block by block.
/// `place` is where the companion will stand, `scratch` where it is written; the pixel size (um) is that of the
/// recording if none is given. UserError: no contours or masks, no pixel size, damaged data, a full disk.
FeaturesSummary features_of_recording(const std::filesystem::path& recording, const std::filesystem::path& place,
                                      const std::filesystem::path& scratch, std::optional<double> given_pixel_size_um,
                                      const TellProgress& on_progress);

}  // namespace rheocyte
