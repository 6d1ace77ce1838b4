// A table of cells with bulk and cortex: states on branches of one radius, fraction of the cortex and tension each,
// with the features by which their moduli are determined separately.
#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shape/outline_shape.h"
#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// Of all features (shape/outline_shape.h): "area_um2", ..., "mode_12".
std::vector<std::string> feature_names();

struct CombinedBranch {
  SweepPoint place;
  std::vector<double> stiffness_kPa;  ///< S = E + E2D / r0, falling
  Eigen::MatrixXd value;              ///< samples x features
  Eigen::MatrixXd slope;              ///< d(value)/d(ln S)
  std::vector<double> error;          ///< estimated, relative, of the deformation

  int samples() const { return int(stiffness_kPa.size()); }
};

struct CombinedTable {
  TableSpec spec;
  std::vector<CombinedBranch> branches;  ///< those with a sample, in the order of the sweep
};

/// The modes of the computed contours with their slopes are added to the measures of the branches.
CombinedTable make_combined_table(const TableSpec& spec, std::span<const SampledBranch> branches);

/// All samples with E, E2D and tension, and slopes; the shortest digits that give back the same numbers.
std::string combined_table_csv(const CombinedTable& table);
/// One line for each branch: how it ended, and where.
std::string combined_ends_csv(const TableSpec& spec, std::span<const SampledBranch> branches);

/// Name of the first of these files.
std::string combined_table_name(const TableSpec& spec);

/// UserError with file and line: other columns, numbers that are none, rows that are not in order.
CombinedTable parse_combined_table(const TableSpec& spec, std::string_view csv, const std::string& name);

/// The table as one file, combined_<identifier>.cbor.
std::string combined_file_name(const std::string& identifier);
std::string to_bytes(const CombinedTable&);
/// UserError naming `name` if the bytes are damaged or no combined table, or hold what no cell has.
CombinedTable combined_from_bytes(std::string_view bytes, const std::string& name);
/// Why these are no states along a branch; the end of a sentence, empty: they are.
std::string_view why_no_branch(const CombinedBranch& branch);

/// Of that file, or of the folder of a finished combined table. UserError if it is none.
CombinedTable read_combined_table(const std::filesystem::path& place);

}  // namespace rheocyte
