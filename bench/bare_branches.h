// The branches of a table whose surface is bare, and random cells of them.
#pragma once
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "case/scales.h"
#include "numeric/cell_random.h"
#include "synth/cell_shapes.h"
#include "table/table_folder.h"

namespace rheocyte {

/// Those that are computed; the table need not be complete.
inline std::vector<SampledBranch> bare_branches(const TableFolder& folder) {
  std::vector<SampledBranch> branches;
  for (int i = 0; i < folder.branches(); ++i)
    if (folder.has(i, false)) branches.push_back(folder.read(i, false));
  return branches;
}

/// Between two numbers, all logarithms as likely.
inline double log_uniform(CellRandom& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

/// A cell of any of the table's radii; nothing if there is none, or one that is deformed less or more.
inline std::optional<CellShape> random_shape(const CellShapes& shapes, const TableSpec& spec, CellRandom& random,
                                             double min_deformation, double max_deformation) {
  const auto radii = sweep_radii_um(spec);
  const double radius = radii.front() + random.uniform() * (radii.back() - radii.front());
  const auto shape = shapes.shape({radius, log_uniform(random, 0.5, 60), channel_flow_of(spec.base).viscosity_mPas});
  const auto* const found = std::get_if<CellShape>(&shape);
  if (!found || found->deformation < min_deformation || found->deformation > max_deformation) return {};
  return *found;
}

}  // namespace rheocyte
