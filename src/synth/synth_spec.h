// What a virtual recording is to contain. Keys, ranges and defaults stand in synth_keys.cc only.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/spread.h"
#include "measurement/pixel_contour.h"
#include "measurement/viscosity.h"

namespace rheocyte {

enum class CellKind { solid, shell, combined };
enum class Pictures { none, masks, images };  ///< images: masks and pictures in shades of grey

struct SynthSpec {
  // [recording]
  double cells = 0, seed = 0, frame_rate_Hz = 0, cells_per_s = 0, pixel_size_um = 0;
  double width_px = 0, height_px = 0;  ///< height 0: as high as the channel and its walls
  Pictures pictures = Pictures::masks;
  std::string sample, date, time;
  std::vector<double> places_um;  ///< behind a contraction, at each of which every cell is seen; empty: once, anywhere
  // [channel], [flow]
  double channel_width_um = 0, flow_rate_ul_s = 0;
  std::optional<double> viscosity_mPas;
  std::string medium;  ///< empty: the viscosity is given
  ViscosityModel viscosity_model = ViscosityModel::buyukurganci_2022;
  Spread temperature_C;
  std::optional<Spread> axial_tension_Pa;  ///< of cells of a table of elongated ones
  // [cell]
  CellKind kind = CellKind::solid;
  Spread radius_um;
  std::optional<Spread> young_modulus_kPa;                ///< of solids and combined cells
  std::optional<Spread> cortex_modulus_mN_per_m;          ///< E2D of shells and combined cells
  std::optional<Spread> tension_ratio, tension_mN_per_m;  ///< at most one; of shells the same ratio for all
  std::optional<Spread> viscosity_of_cell_mPas;           ///< of cells on their way
  std::optional<Spread> rest_aspect;                      ///< of cells of a table of such ones
  double added_ellipse = 0;                               ///< mode c_2 that is added to each outline
  // [shapes]
  bool analytical = false;      ///< by the analytical model
  std::filesystem::path table;  ///< folder of a table of `rheocyte table`, or a grid; empty: the program's own
  double max_deformation = 0;
  bool square_duct = false;
  // [noise]
  double lateral_um = 0, contour_um = 0, contour_correlation_um = 0, thermometer_C = 0;

  std::string made_of;  ///< the cells of the model of shapes, as in cells_in_words, once that is known

  /// Whether the cells are seen on their way, by a dynamic table.
  bool is_on_its_way() const { return !places_um.empty(); }
  /// Young's modulus (kPa) of solids and combined cells, modulus E2D (mN/m) of shells.
  const Spread& stiffness() const { return (young_modulus_kPa ? young_modulus_kPa : cortex_modulus_mN_per_m).value(); }
  ImageSize image_size() const;
};

/// Reads and checks a spec; `name` stands for its file in messages. UserError: one sentence with file, line, key,
/// value, range and the nearest known key.
SynthSpec parse_synth_spec(std::string_view text, const std::string& name, std::span<const std::string> settings = {});

}  // namespace rheocyte
