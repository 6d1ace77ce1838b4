// A small look-up table in the format of the published ones.
#pragma once
#include <filesystem>

namespace rheocyte::test {

/// Areas 20 to 300 um^2, deformations 0 to 0.2 on a grid, E = 0.001 area / (deformation + 0.01) kPa; 20 um, 0.04 ul/s,
/// 15 mPa s, identifier "TEST".
void write_lookup_table(const std::filesystem::path& file);

}  // namespace rheocyte::test
