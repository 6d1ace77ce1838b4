// The settings of a set-up with the tables that belong to them: what set-ups share that differ in their tension.
#pragma once
#include <array>
#include <mutex>
#include <vector>

#include "infer/grid_map.h"
#include "instrument/rheocyte_cell.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {

/// As `rheocyte extract` takes them for a recording with these settings (events/extract_settings.h). UserError.
MeasuringConditions conditions_of(const rheocyte_cell_settings& settings);

struct MeasuredSetUp {
  explicit MeasuredSetUp(const rheocyte_cell_settings& settings);

  /// Cells with a cortex, read when they are needed. UserError without their tables.
  ProportionedTables proportioned() const;

  MeasuringConditions conditions;
  ModulusTables tables;
  const GridMap* map;  ///< of the tables
  double reynolds;
  std::vector<double> viscosity_mPas;  ///< the same of each of the cells that are computed together

 private:
  mutable std::mutex reading_;
};

}  // namespace rheocyte
