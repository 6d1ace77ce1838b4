// One case as the user states it, in physical units. Keys, ranges and meanings stand in case_keys.cc only.
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "case/choices.h"

namespace rheocyte {

/// A channel that is not straight, by its radii or by the widths of a chip of constant height, of which a tube stands
/// for the chip or the funnel is computed itself, in three dimensions; empty for a straight one.
struct ChannelProfile {
  std::vector<double> x_um, R_um, width_um;
  std::optional<double> rounding_um = {};     ///< only of a funnel in three dimensions
  std::vector<double> axial_tension_Pa = {};  ///< in place of that of the flow; empty: the same everywhere
};

/// From where a duct is seen; any angle stands in camera_degree.
enum class View { side, diagonal };

/// The tube, or the square channel that is mapped to it, or the profile; exactly one of the three is given.
struct Channel {
  Section section = Section::tube;
  std::optional<double> width_um, radius_um;
  std::optional<double> height_um = {};  ///< only of a rectangle
  std::optional<double> length_um = {};  ///< only where the pressure drop is given
  ChannelProfile profile = {};
  std::optional<View> camera = {};  ///< only in a duct, if not as an angle
  std::optional<double> camera_degree = {};
};

inline Camera camera_of(const Channel& channel) {
  if (channel.camera_degree) return {*channel.camera_degree};
  return channel.camera == View::diagonal ? Camera::diagonal : Camera::side;
}

/// The liquid and how much of it flows. Empty: the key has no effect for this law.
struct Flow {
  Drive drive = Drive::rate;
  std::optional<double> rate_ul_per_s, pressure_drop_Pa;
  LiquidLaw law = LiquidLaw::newtonian;
  std::optional<double> viscosity_mPas, consistency_Pa_sn, exponent, shear_rate_floor;
  std::optional<double> zero_shear_viscosity_mPas, infinite_shear_viscosity_mPas, relaxation_time_ms, yasuda_exponent;
  double density_kg_per_m3 = 0;
  double axial_tension_Pa = 0;
};

/// The interior of the cell.
struct BulkCase {
  BulkLaw law = BulkLaw::neo_hookean;
  std::optional<double> young_modulus_kPa, c1_fraction, stiffening;
};

/// The cell's surface. Tension is given in mN/m or as a fraction of the modulus, not both.
struct CortexCase {
  CortexLaw law = CortexLaw::none;
  std::optional<double> modulus_mN_per_m, tension_mN_per_m, tension_ratio;
  double bending_kBT = 0;
  std::optional<double> area_constant = {};  ///< only of Skalak's law
};

struct Cell {
  double radius_um = 0;
  BulkCase bulk;
  CortexCase cortex;
  std::optional<double> viscosity_mPas, density_kg_per_m3;  ///< only in time
  std::optional<Viscoelasticity> viscoelasticity = {};      ///< as above
  std::optional<double> branch_modulus_kPa = {};            ///< only of a standard linear solid
  std::vector<double> offset_um = {};                       ///< in a duct: along width and height; empty: centred
  CellPlace place = CellPlace::given;
  double rest_aspect = 1;
};

/// Whether the cell is on the axis of the channel.
inline bool is_centred(const Cell& cell) {
  return std::ranges::all_of(cell.offset_um, [](double offset) { return offset == 0; });
}

/// The way of the cell in time; all but the scheme empty for a stationary case.
struct TimeCase {
  TimeScheme scheme = TimeScheme::stationary;
  std::optional<double> end_us, end_um, output_every_us, output_every_um, accuracy, step_us, grid_um, mesh_accuracy,
      degree, start_stretch;
};

struct Numerics {
  double accuracy = 0;
  std::optional<AccuracyOf> accuracy_of = {};  ///< only of a cell off the axis
};

/// A value that read_case returns is complete and inside every range; a default-constructed one is not.
struct Case {
  Channel channel;
  Flow flow;
  Cell cell;
  TimeCase time;
  Numerics numerics;
};

}  // namespace rheocyte
