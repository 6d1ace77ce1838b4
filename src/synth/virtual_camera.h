// What a camera records of virtual cells, one after the other: features and pictures of their outlines.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "measurement/viscosity.h"
#include "synth/cell_shapes.h"
#include "synth/synth_spec.h"
#include "synth/virtual_recording.h"

namespace rheocyte {

/// Of the tension or the shape at rest, one of which a table has; dclab knows userdef0 to userdef9.
inline constexpr const char* elongation_feature = "userdef0";

/// All that is written of a block of events.
struct VirtualEvents {
  std::map<std::string, std::vector<double>> columns;
  std::vector<std::uint8_t> masks, images;
  std::size_t events = 0;
};

/// Cells come from their own random numbers each. Spec, shapes and result, in which it counts, must outlive it.
class VirtualCamera {
 public:
  VirtualCamera(const SynthSpec& spec, const CellShapes& shapes, VirtualRecording& result);

  /// Adds the cell of this number to the block, if it can be seen; a cell on its way at each of its places.
  void take(std::uint64_t number, VirtualEvents& block);

 private:
  /// Of a picture: numbers of its cell and of itself.
  struct Picture {
    std::uint64_t cell, number;
    double celsius;
  };
  std::pair<VirtualCell, double> drawn(std::uint64_t number) const;
  void see(const VirtualCell& cell, const Picture& picture, VirtualEvents& block);
  bool is_combined() const { return spec_.kind == CellKind::combined; }
  std::uint64_t seed() const { return static_cast<std::uint64_t>(spec_.seed); }
  void count(NoShape reason) { ++result_.missing[static_cast<std::size_t>(reason)]; }

  /// In pixels; the cell lies anywhere between the pixels.
  Eigen::MatrixX2d outline_in_picture(const CellShape& shape, const VirtualCell& cell, std::uint64_t number);
  double axis() const { return 0.5 * static_cast<double>(size_.height - 1); }

  void add_features(const ContourFeatures& features, VirtualEvents& block) const;
  void add_truth(const VirtualCell& cell, const CellShape& shape, const ContourFeatures& features,
                 VirtualEvents& block);
  void arrive(std::uint64_t number);
  void add_time(const CellShape& shape, const Picture& picture, VirtualEvents& block);
  void add_pictures(const Eigen::MatrixX2d& outline, std::uint64_t number, VirtualEvents& block) const;

  const SynthSpec& spec_;
  const CellShapes& shapes_;
  ImageSize size_;
  VirtualRecording& result_;
  std::optional<Buffer> buffer_;
  std::vector<std::uint8_t> mask_;
  ContourFinder finder_;
  ContourMeasurer measurer_;
  double frame_ = 0;
};

}  // namespace rheocyte
