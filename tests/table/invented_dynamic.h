// A dynamic table without a solver: cells that approach a final shape exponentially.
#pragma once
#include <cmath>
#include <string>

#include "case/scales.h"
#include "table/dynamic_table.h"

namespace rheocyte::test {

inline const std::string dynamic_spec_text = R"([channel.profile]
x_um = [60.0, 100.0]
R_um = [21.88, 10.94]
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
density_kg_per_m3 = 0.0
[dynamic]
identifier = "invented"
min_radius_um = 5.0
max_radius_um = 8.0
min_young_modulus_kPa = 3.0
max_young_modulus_kPa = 20.0
checks = 4
)";

/// c_3 of such a cell, as large and as fast as that of the solver's cells.
inline double invented_mode_3(const DynamicCell& cell, double place_um) {
  constexpr double speed_um_per_ms = 170, start_um = 15, liquid_ms = 0.03;
  const double softness = std::pow(cell.radius_um / 8, power_of_radius) * 3 / cell.young_modulus_kPa;
  return 0.15 * softness / (1 + 0.1 * softness) *
         (1 - std::exp(-(place_um + start_um) / (speed_um_per_ms * (cell.time_ms + liquid_ms))));
}

inline CellCourse invented_course(const DynamicSpec& spec, const DynamicCell& cell) {
  const auto places = places_of(spec);
  CellCourse course{cell, Status::converged, "invented", Eigen::MatrixXd(Eigen::Index(places.size()), course_measures)};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double c = invented_mode_3(cell, places[i]);
    course.value.row(Eigen::Index(i)) << 2 * c * c, 1 + c * c, 1 + 0.1 * c, 0.05 * c, c, 0, 0.1 * c, 0, 0, 1.6,
        places[i] / 17;
  }
  return course;
}

/// The same behind the planar funnel of a square channel.
inline const std::string square_dynamic_spec_text = R"([channel]
section = "square"
[channel.profile]
x_um = [30.0, 70.0]
width_um = [100.0, 20.0]
[cell]
density_kg_per_m3 = 0.0
)" + dynamic_spec_text.substr(dynamic_spec_text.find("[flow]"));

inline DynamicContent invented_dynamic(const std::string& spec_text = dynamic_spec_text) {
  DynamicContent content{parse_dynamic_spec(spec_text, "invented.toml"), "a test", {}};
  for (const DynamicCell& cell : cells_of(content.spec)) content.courses.push_back(invented_course(content.spec, cell));
  return content;
}

}  // namespace rheocyte::test
