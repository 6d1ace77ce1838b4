// One branch of stationary states at one radius: samples with slopes, and dense output between them.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "state/outcome.h"
#include "state/state_measures.h"

namespace rheocyte {

inline constexpr int measure_count = int(table_measures.size());

/// A column of the tables: one of the measures of a state that they hold, in physical units.
class Measure {
 public:
  constexpr explicit Measure(int column) : column_(column) {}
  constexpr explicit operator int() const { return column_; }
  constexpr bool operator==(const Measure&) const = default;

  /// Those that the program asks for itself.
  static const Measure deformation, deformation_raw, area_um2, volume_um3, moment_ratio, mode_3, min_meridional_stretch,
      stability_margin;

  /// By its name, which must be that of a column: no other compiles.
  static consteval Measure named(std::string_view name) {
    const auto place = std::ranges::find(table_measures, name, &StateMeasure::name);
    return Measure(place == table_measures.end() ? throw name : int(place - table_measures.begin()));
  }

 private:
  int column_;
};

inline constexpr Measure Measure::deformation = named("deformation"),
                         Measure::deformation_raw = named("deformation_raw"), Measure::area_um2 = named("area_um2"),
                         Measure::volume_um3 = named("volume_um3"), Measure::moment_ratio = named("moment_ratio"),
                         Measure::mode_3 = named("mode_3"),
                         Measure::min_meridional_stretch = named("least_meridional_stretch"),
                         Measure::stability_margin = named("stability_margin");

/// How a branch ended at its soft side.
struct BranchEnd {
  Status status = Status::not_started;
  std::string message;  ///< one sentence
  /// Whether the cell has no state beyond; otherwise the table or the numerics end there.
  bool is_physical() const {
    return status == Status::surface_unstable || status == Status::limit_point || status == Status::branch_ended;
  }
};

/// The end with its sentence.
BranchEnd end_of(Status status);

/// Samples from stiff to soft; every row of the matrices is one converged state within the requested accuracy.
struct SampledBranch {
  double radius_um = 0;    ///< of the sphere at rest
  double bending_kBT = 0;  ///< that holds the last sample's surface beyond the bare branch; 0: the case's own branch
  std::vector<double> stiffness;                ///< value of the swept parameter, falling
  Eigen::MatrixXd value;                        ///< samples x measures
  Eigen::MatrixXd slope;                        ///< d(value)/d(ln stiffness)
  std::vector<double> error;                    ///< estimated, relative, of the deformation
  std::vector<Eigen::MatrixX2d> contour;        ///< (x, r) in um from front to rear pole, the same points in all
  std::vector<Eigen::MatrixX2d> contour_slope;  ///< d/d(ln stiffness)
  BranchEnd end;
  int solves = 0, newton_iterations = 0, refused = 0;  ///< refused: states that were wrinkled or not accurate
  double seconds = 0, factorisation_seconds = 0;
  double cortex_fraction = 0, tension_ratio = 0;  ///< of combined cells, see SweepPoint
  double axial_ratio = 0;                         ///< of elongated cells; as above

  bool empty() const { return stiffness.empty(); }
  int samples() const { return int(stiffness.size()); }
  double at(int sample, Measure m) const { return value(sample, int(m)); }
};

/// Samples through whose values and slopes a polynomial between two of them runs.
inline constexpr std::size_t samples_around = 4;

/// Whether the outline has a dent that the convex hull bridges: where one appears, what is measured on the hull is less
/// smooth than the outline, and no polynomial runs across.
inline bool is_dented(double deformation, double deformation_raw) { return deformation_raw > deformation * (1 + 1e-5); }

/// Hermite interpolation of a measure in 1 / stiffness, of deformations by their logarithm. The stiffness must lie
/// between the samples' (asserted).
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
