#include "report/moduli_json.h"

#include "report/moduli_summary_columns.h"
#include "report/rows_json.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

using nlohmann::ordered_json;

ordered_json counts_of(const ModuliSummary& s) {
  ordered_json counts;
  for (int k = 0; k < moduli_status_count; ++k)
    counts[std::string(name_of(ModuliStatus(k)))] = s.counts[std::size_t(k)];
  return counts;
}

ordered_json median_cell_of(const MedianCell& m) {
  if (m.cells < MedianCell::min_cells || m.status == ModuliStatus::no_data) return nullptr;
  ordered_json cell = row_json(median_cell_columns(), m);
  cell["features"] = rows_json(feature_of_median_columns(), features_of(m));
  return cell;
}

}  // namespace

std::string moduli_json(const std::filesystem::path& recording, const std::string& table, const ModuliSummary& s) {
  ordered_json content{{"made_by", "rheocyte moduli"},
                       {"version", version},
                       {"recording", recording.string()},
                       {"table", table},
                       {"events", counts_of(s)}};
  content.update(row_json(moduli_summary_columns(), s));
  content["slopes_between_cells"] = rows_json(slope_columns(), slopes_of(s.axial));
  content["median_cell"] = median_cell_of(s.median_cell);
  content["warnings"] = s.warnings;
  return content.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace rheocyte
