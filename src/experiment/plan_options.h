// What is asked of `rheocyte plan`.
#pragma once
#include <string>
#include <vector>

#include "numeric/no_value.h"

namespace rheocyte {

/// What has no value here must be given.
struct PlanOptions {
  double radius_um = no_value, young_modulus_kPa = no_value;  ///< of the median cell
  double spread = 0.2, radius_spread = 0.07;                  ///< standard deviations of ln E and ln r0 between cells
  double between_recordings = 0.03, difference = 0.1;         ///< scatter of ln E, and relative difference of E
  double power = 0.8, cells = 500;                            ///< wanted; cells of a recording
  double mode_2 = 0.1;                                        ///< how elongated the cells are
  double pixel_size_um = 0.34, temperature_C = 23;
  std::vector<double> widths_um{15, 20, 30};
  std::vector<std::string> media{"0.49% MC-PBS", "0.83% MC-PBS"};
  std::vector<double> rates_ul_s{};  ///< empty: those of mean speeds of 0.04, 0.1, 0.2 and 0.4 m/s
};

}  // namespace rheocyte
