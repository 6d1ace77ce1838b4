// One branch of stationary states at one radius: samples with slopes, and dense output between them.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

/// What is known of each state, in physical units.
enum class Measure {
  deformation,
  deformation_raw,
  area_um2,
  area_raw_um2,
  perimeter_um,
  volume_um3,
  moment_ratio,      ///< Lambda1 / Lambda2 of the hull
  moment_ratio_raw,  ///< of the contour
  inertia_ratio,     ///< sqrt(Lambda2 / Lambda1) of the hull
  cell_velocity_m_per_s,
  additional_pressure_drop_Pa,
  least_meridional_stretch,
  stability_margin,
  count
};
inline constexpr int measure_count = int(Measure::count);
/// Column names, in the order of the enumeration.
extern const std::array<std::string_view, measure_count> measure_names;

/// How a branch ended at its soft side.
struct BranchEnd {
  std::string status;   ///< "covered", or the name of a Status: "surface-unstable", "branch-ended", ...
  std::string message;  ///< one sentence
};

/// Samples from stiff to soft; every row of the matrices is one converged state within the wanted accuracy.
struct SampledBranch {
  double radius_um = 0;    ///< of the sphere at rest
  double bending_kBT = 0;  ///< that holds the surface beyond the end of the bare branch; 0: the case's own branch
  std::vector<double> stiffness;                ///< value of the swept parameter, falling
  Eigen::MatrixXd value;                        ///< samples x measures
  Eigen::MatrixXd slope;                        ///< d(value)/d(ln stiffness)
  std::vector<double> error;                    ///< estimated, relative, of the deformation
  std::vector<Eigen::MatrixX2d> contour;        ///< (x, r) in um from front to rear pole, the same points in all
  std::vector<Eigen::MatrixX2d> contour_slope;  ///< d/d(ln stiffness)
  BranchEnd end;
  int solves = 0, newton_iterations = 0, refused = 0;  ///< refused: states that were wrinkled or not accurate
  double seconds = 0, factorisation_seconds = 0;
  double cortex_share = 0, tension_ratio = 0;  ///< of combined cells, see BranchPlace

  bool empty() const { return stiffness.empty(); }
  int samples() const { return int(stiffness.size()); }
  double at(int sample, Measure m) const { return value(sample, int(m)); }
};

/// Cubic Hermite interpolation of a measure in ln stiffness; ln deformation for the deformations. The stiffness must
/// lie between the samples' (asserted).
double interpolate(const SampledBranch&, Measure, double stiffness);
/// All measures at once.
Eigen::VectorXd interpolate(const SampledBranch&, double stiffness);
/// The contour in um.
Eigen::MatrixX2d interpolate_contour(const SampledBranch&, double stiffness);
/// The stiffness at which a (monotonic) measure has a value; NaN outside the samples.
double stiffness_at(const SampledBranch&, Measure, double value);

/// The record of a branch as bytes (CBOR with a checksum), and back. UserError naming `name` if the bytes are damaged,
/// cut, or of another spec.
std::string to_bytes(const SampledBranch&, const std::string& spec_hash);
SampledBranch branch_from_bytes(std::string_view bytes, const std::string& spec_hash, const std::string& name);

/// What a record of this program is: programs with equal words can read each other's.
std::string branch_record_format();

}  // namespace rheocyte
