// Which cells recordings are of, where the user does not say: by the rule of `rheocyte extract`, whose recommended
// modulus is that of solids or the effective one.
#pragma once
#include <string>
#include <vector>

#include "experiment/population_recordings.h"
#include "store/watch.h"

namespace rheocyte {

struct ChosenModel {
  std::string name;  ///< as of --model
  std::string why;   ///< in words; empty if the user has chosen
};

/// The user's, or "effective" if most recordings whose shapes are known have an effective modulus, else "solid";
/// options that only solids have mean these. Reads each recording in a process of its own. StoppedBySignal once `watch`
/// wants the end; UserError for what is wrong with a recording.
ChosenModel model_of_shapes(const std::vector<PopulationCondition>& conditions, const PopulationOptions& options,
                            const Watch& watch);

}  // namespace rheocyte
