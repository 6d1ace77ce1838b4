#include "synth/virtual_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "case/split.h"
#include "case/user_error.h"
#include "measurement/metadata.h"
#include "measurement/recording_file.h"
#include "measurement/viscosity.h"
#include "synth/virtual_camera.h"

namespace rheocyte {

namespace {

constexpr std::size_t cells_per_block = 1024;  // events that are written together
const std::string elongation_key = fmt::format("user:rheocyte {}", elongation_feature);
constexpr const char *meaning_of_tension = "true axial tension (Pa)",
                     *meaning_of_aspect = "true length over width at rest";

void write_metadata(const SynthSpec& spec, const RecordingProvenance& provenance, RecordingFile& file) {
  const ImageSize size = spec.image_size();
  file.add_metadata("experiment:date", spec.date);
  file.add_metadata("experiment:time", spec.time);
  file.add_metadata("experiment:run index", std::int64_t{1});
  file.add_metadata("experiment:sample", spec.sample);
  file.add_metadata("imaging:flash device", std::string("none (virtual)"));
  file.add_metadata("imaging:flash duration", 1.0);
  file.add_metadata("imaging:frame rate", spec.frame_rate_Hz);
  file.add_metadata("imaging:pixel size", spec.pixel_size_um);
  file.add_metadata("imaging:roi position x", std::int64_t{0});
  file.add_metadata("imaging:roi position y", std::int64_t{0});
  file.add_metadata("imaging:roi size x", static_cast<std::int64_t>(size.width));
  file.add_metadata("imaging:roi size y", static_cast<std::int64_t>(size.height));
  constexpr double sheath_fraction = 0.75;  // of the flow, as usual
  file.add_metadata("setup:channel width", spec.channel_width_um);
  file.add_metadata("setup:chip region", std::string("channel"));
  file.add_metadata("setup:flow rate", spec.flow_rate_ul_s);
  file.add_metadata("setup:flow rate sample", (1 - sheath_fraction) * spec.flow_rate_ul_s);
  file.add_metadata("setup:flow rate sheath", sheath_fraction * spec.flow_rate_ul_s);
  file.add_metadata("setup:identifier", std::string("virtual"));
  file.add_metadata("setup:medium", spec.medium.empty() ? std::string("other") : spec.medium);
  file.add_metadata("setup:module composition", std::string("virtual"));
  file.add_metadata("setup:software version", provenance.program);
  if (spec.viscosity_mPas)
    file.add_metadata(viscosity_key, *spec.viscosity_mPas);
  else
    file.add_metadata("setup:temperature", spec.temperature_C.mean);
}

void describe_truth(const SynthSpec& spec, const CellShapes& shapes, const VirtualRecording& result,
                    RecordingFile& file) {
  const char* const cortex = "cortex modulus E2D (mN/m)";
  std::vector<const char*> meanings{"radius of the sphere at rest (um)",
                                    spec.kind == CellKind::shell ? cortex : "Young's modulus (kPa)",
                                    "area of the convex hull (um^2)",
                                    "deformation of the convex hull",
                                    "volume (um^3)",
                                    "viscosity (mPa s)"};
  if (spec.is_on_its_way())
    meanings.insert(meanings.end(), {"viscosity of the cell (mPa s)", "place behind the contraction (um)", "number"});
  if (spec.kind == CellKind::combined) meanings.insert(meanings.end(), {cortex, "tension of the cortex (mN/m)"});
  for (std::size_t k = 0; k < meanings.size(); ++k)
    file.add_metadata(fmt::format("user:rheocyte userdef{}", k + 1), fmt::format("true {}", meanings[k]));
  if (spec.axial_tension_Pa || spec.rest_aspect)
    file.add_metadata(elongation_key, spec.rest_aspect ? meaning_of_aspect : meaning_of_tension);
  file.add_metadata("user:rheocyte shapes", shapes.description());
  if (!spec.made_of.empty()) file.add_metadata(made_of_key, spec.made_of);
  file.add_metadata("user:rheocyte seed", static_cast<std::int64_t>(spec.seed));
  file.add_metadata("user:rheocyte cells drawn", static_cast<std::int64_t>(result.cells));
  for (std::size_t k = 0; k < result.missing.size(); ++k)
    if (result.missing[k] > 0)
      file.add_metadata(fmt::format("user:rheocyte cells {}", names_of_missing_shapes[k]),
                        static_cast<std::int64_t>(result.missing[k]));
}

void write_block(VirtualEvents& block, ImageSize size, RecordingFile& file) {
  for (auto& [name, values] : block.columns) {
    file.append(name, values);
    values.clear();
  }
  file.append_images("mask", size, block.masks);
  file.append_images("image", size, block.images);
  block.masks.clear();
  block.images.clear();
  block.events = 0;
}

std::string reasons(const VirtualRecording& result) {
  std::string text;
  for (std::size_t k = 0; k < result.missing.size(); ++k)
    if (result.missing[k] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", result.missing[k], names_of_missing_shapes[k]);
  return text;
}

}  // namespace

std::optional<Elongation> elongation_of_cells(const Metadata& metadata) {
  const auto meaning = metadata.text(elongation_key);
  if (meaning == meaning_of_tension) return Elongation::by_tension;
  if (meaning == meaning_of_aspect) return Elongation::by_rest_shape;
  return {};
}

std::string_view noun_of_missing(const VirtualRecording& result) {
  return result.pictures == result.cells ? "cells" : "pictures of cells";
}

VirtualRecording write_virtual_recording(const SynthSpec& spec, const CellShapes& shapes,
                                         const RecordingProvenance& provenance, const std::filesystem::path& path,
                                         const std::function<void(double)>& on_progress) {
  VirtualRecording result;
  RecordingFile file(path);
  write_metadata(spec, provenance, file);
  VirtualCamera camera(spec, shapes, result);
  VirtualEvents block;
  const auto cells = static_cast<std::uint64_t>(spec.cells);
  constexpr std::size_t max_block_bytes = 64 << 20;
  const std::size_t step = std::clamp<std::size_t>(max_block_bytes / spec.image_size().pixels(), 1, cells_per_block);
  for (std::uint64_t number = 0; number < cells; ++number) {
    camera.take(number, block);
    if (block.events >= step) write_block(block, spec.image_size(), file);
    if (number % 64 == 63) on_progress(static_cast<double>(number) / static_cast<double>(cells));
  }
  write_block(block, spec.image_size(), file);
  if (result.events == 0)
    throw UserError(fmt::format("None of the {} {} can be recorded: {}; the shapes come from the {}.", result.pictures,
                                noun_of_missing(result), reasons(result), shapes.description()));
  result.mean_area_error /= static_cast<double>(result.events);
  result.mean_deformation_error /= static_cast<double>(result.events);
  describe_truth(spec, shapes, result, file);
  file.add_log("rheocyte-synth", text_lines(provenance.spec));
  file.close();
  return result;
}

}  // namespace rheocyte
