// A stationary state in physical units.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "case/case.h"
#include "solve/stationary.h"

namespace rheocyte {

/// A state together with what turns it into physical numbers.
struct Result {
  Case input;
  Scales scales;
  Problem problem;
  StationaryState state;
};

/// Solver's results are not trusted blindly: a converged state with a number that is not finite becomes `not_finite`.
void refuse_unfinite_numbers(StationaryState&);

/// The content of result.json. Numbers that are not finite are null; the status then is not "converged".
nlohmann::ordered_json to_json(const Result&);

/// contour.csv: the meridian from the front pole to the rear one, densely sampled, in um, with stretches, tensions and
/// curvatures of the surface.
std::string contour_csv(const Result&);

/// The lines that `rheocyte solve` prints at its end.
std::string summary(const Result&, const std::string& folder);

}  // namespace rheocyte
