// What `rheocyte moduli` reports of a recording, as columns.
#pragma once
#include <string>
#include <vector>

#include "extract/moduli_summary.h"
#include "report/column.h"

namespace rheocyte {

/// Medians and quartiles of the moduli, and the axial tension that all cells have in common.
Columns<ModuliSummary> moduli_summary_columns();

/// The cell whose shape is the median.
Columns<MedianCell> median_cell_columns();

/// A feature of it: measured, and of the cell of the table.
struct FeatureOfMedian {
  std::string name;
  double measured, error, fitted;
};
std::vector<FeatureOfMedian> features_of(const MedianCell& cell);
Columns<FeatureOfMedian> feature_of_median_columns();

/// How one mode changes with c_2 between the cells, and what the model says of it.
struct SlopeBetweenCells {
  std::string name;
  double value, error, by_stiffness, by_cortex_fraction, by_tension_ratio, by_axial_tension;
};
/// None where they are not known.
std::vector<SlopeBetweenCells> slopes_of(const AxialSummary& summary);
Columns<SlopeBetweenCells> slope_columns();

}  // namespace rheocyte
