// The recordings of examples/recordings for tests.
#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "shelf/virtual_cells.h"
#include "synth/virtual_recording.h"

namespace rheocyte::test {

/// Fewer cells of examples/recordings/virtual-cells.toml, with pictures and masks; others with another seed.
inline void write_virtual_cells(const std::filesystem::path& file, int cells, int seed = 1) {
  const std::string spec_file = std::string(EXAMPLES) + "/recordings/virtual-cells.toml";
  std::ifstream stream(spec_file);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  const std::vector<std::string> settings{"recording.cells=" + std::to_string(cells),
                                          "recording.seed=" + std::to_string(seed)};
  SynthSpec spec = parse_synth_spec(text, spec_file, settings);
  write_virtual_recording(spec, *virtual_cells(spec, {}), {"rheocyte test", text}, file, [](double) {});
}

}  // namespace rheocyte::test
