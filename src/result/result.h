// A stationary state in physical units.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"
#include "result/field.h"
#include "solve/stationary.h"

namespace rheocyte {

/// Derivatives of a state with respect to a number of its case, each in the unit of what is differentiated over that of
/// the key. Not numbers where they could not be found.
struct Gradient {
  std::string_view key;
  Eigen::VectorXd measures;  ///< in the order of state_measures
  Eigen::MatrixXd surface;   ///< of the columns of contour.csv, row by row at the same material points
};

/// A state together with what turns it into physical numbers.
struct Result {
  Case input;
  Scales scales;
  Problem problem;
  StationaryState state;
  std::vector<Gradient> gradients = {};  ///< those that were asked for
};

/// Solver's results are not trusted blindly: a converged state with a number that is not finite becomes `not_finite`.
void refuse_unfinite_numbers(Result&);

/// Of the requested cell (analytic/effective_modulus.h).
double effective_modulus_kPa(const Result&);

/// The content of result.json. Numbers that are not finite are null; the status then is not "converged".
nlohmann::ordered_json to_json(const Result&);

/// One step of its branch.
struct StepOfResult {
  const Result& result;
  const BranchStep& step;
};

/// The keys of result.json beside the measures of the state, and those of its objects.
std::span<const Field<Result, nlohmann::ordered_json>> outcome_fields(), computation_fields(), thread_fields();
std::span<const Field<StepOfResult, nlohmann::ordered_json>> branch_fields();
std::span<const Field<SolveStatistics, nlohmann::ordered_json>> statistics_fields();

/// A point of the surface.
struct ProfilePoint {
  const SurfaceProfile& surface;
  Eigen::Index row;
};

/// contour.csv: the meridian from the front pole to the rear one, densely sampled, in um, with stretches, tensions and
/// curvatures of the surface.
std::string contour_csv(const SurfaceProfile&, const Scales&);
std::span<const Field<ProfilePoint>> contour_fields();  ///< its columns; the values are dimensionless

/// contour_offset.csv: the closed outline of a cell off the axis in the plane of its offset, in um.
std::string offset_outline_csv(const Eigen::MatrixX2d& outline, const Scales&);

/// The lines that `rheocyte solve` prints at its end.
std::string summary(const Result&, const std::string& folder);

}  // namespace rheocyte
