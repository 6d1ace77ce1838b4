// Where the lines of equal modulus in a picture come from: a table of whichever kind.
#pragma once
#include <filesystem>
#include <variant>

#include "infer/grid_lines.h"
#include "infer/level_lines.h"

namespace rheocyte {

class LineSource {
 public:
  /// UserError.
  explicit LineSource(const std::filesystem::path& table);

  /// As in LineFinder.
  std::vector<double> even_levels(int count) const;
  LevelLines lines(std::span<const double> levels_kPa) const;
  std::vector<PlanePoint> support() const;
  /// By which law the events of a picture are taken to be seen.
  PixelCorrection pixel_correction() const;

 private:
  std::variant<LineFinder, GridLineFinder> finder_;
};

}  // namespace rheocyte
