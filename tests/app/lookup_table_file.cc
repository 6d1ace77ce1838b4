#include "lookup_table_file.h"

#include <fstream>

namespace rheocyte::test {

void write_lookup_table(const std::filesystem::path& file) {
  std::ofstream stream(file);
  stream << "# BEGIN METADATA\n"
            "# {\"channel_width\": 20.0, \"channel_width_unit\": \"um\", \"flow_rate\": 0.04,\n"
            "#  \"flow_rate_unit\": \"uL/s\", \"fluid_viscosity\": 15.0, \"fluid_viscosity_unit\": \"mPa s\",\n"
            "#  \"identifier\": \"TEST\"}\n"
            "# END METADATA\n"
            "# area_um [um^2]\tdeform\temodulus [kPa]\n";
  for (int i = 0; i <= 28; ++i)
    for (int j = 0; j <= 20; ++j) {
      const double area = 20 + 10 * i, deformation = 0.01 * j;
      stream << area << '\t' << deformation << '\t' << 0.001 * area / (deformation + 0.01) << '\n';
    }
}

}  // namespace rheocyte::test
