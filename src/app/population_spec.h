// A specification of `rheocyte population` in TOML: the settings by their names, and the recordings of each condition.
#pragma once
#include <filesystem>
#include <vector>

#include "experiment/population_recordings.h"

namespace rheocyte {

struct PopulationSpec {
  PopulationOptions options;
  std::vector<PopulationCondition> conditions;
};

/// Keys are the settings of PopulationOptions (min and max may be sections of features with their limits), and a
/// section `conditions` of names with lists of recordings, which are seen from the folder of the file. UserError: no
/// such file, no TOML, a key that is none, a value that does not do.
PopulationSpec read_population_spec(const std::filesystem::path& file);

}  // namespace rheocyte
