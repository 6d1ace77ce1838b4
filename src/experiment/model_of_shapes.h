// What `rheocyte extract` says of the shapes of recordings, and which cells a population takes them for where the user
// does not say: solids, or cells with an effective modulus.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "experiment/population_recordings.h"
#include "extract/shape_verdict.h"
#include "store/watch.h"

namespace rheocyte {

/// Of each recording, condition by condition; nothing where a modulus of solids cannot be computed. Reads each one in a
/// process of its own. StoppedBySignal once `watch` wants the end.
std::vector<std::optional<ShapeVerdict>> shapes_of(const std::vector<PopulationCondition>& conditions,
                                                   const PopulationOptions& options, const Watch& watch);

struct ChosenModel {
  std::string name;  ///< as of --model
  std::string why;   ///< in words; empty if the user has chosen
};

/// The user's, or "effective" if most recordings whose shapes are known have an effective modulus, else "solid";
/// options that only solids have mean these.
ChosenModel model_of_shapes(const PopulationOptions& options, const std::vector<std::optional<ShapeVerdict>>& shapes);

}  // namespace rheocyte
