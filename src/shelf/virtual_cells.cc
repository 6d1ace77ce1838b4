#include "shelf/virtual_cells.h"

#include <system_error>

#include "shelf/modulus_tables.h"
#include "shelf/shipped_tables.h"
#include "synth/synth_shapes.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

double flow_exponent(const SynthSpec& spec) {
  if (spec.viscosity_mPas) return 1;
  return Buffer(medium_of_name(spec.medium).value(), spec.viscosity_model).flow_exponent(spec.temperature_C.mean);
}

fs::path found_table(const SynthSpec& spec, const fs::path& folder) {
  if (spec.table.empty()) {
    if (spec.is_on_its_way()) return dynamic_table_or_shipped({});
    if (spec.kind == CellKind::combined) return combined_table_or_shipped({});
    const auto elongated = spec.axial_tension_Pa ? elongated_file(flow_exponent(spec)) : std::nullopt;
    return elongated ? elongated->file : ModulusTables("").file(flow_exponent(spec));
  }
  fs::path beside = folder / spec.table;  // an absolute one stays
  std::error_code error;
  if (fs::exists(beside, error)) return beside;
  auto shipped = shipped_tables();
  shipped.merge(shipped_elongated_tables());
  shipped.merge(shipped_combined_tables());
  shipped.merge(shipped_dynamic_tables());
  const auto found = shipped.find(spec.table.string());
  return found == shipped.end() ? beside : found->second;
}

}  // namespace

std::unique_ptr<CellShapes> virtual_cells(SynthSpec& spec, const fs::path& folder) {
  if (!spec.analytical) spec.table = found_table(spec, folder);
  return shapes_of(spec);
}

}  // namespace rheocyte
