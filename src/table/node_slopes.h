// Derivatives at the nodes of a grid, for bicubic (Hermite) interpolation.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace rheocyte {

/// Of the polynomials through the five (or all) nodes around each, in units of the node distance.
std::vector<double> node_slopes(std::span<const double> values);

/// Columns x rows with the rows of a column behind each other: along the rows of each column, or across the columns of
/// each row.
std::vector<double> slopes_by_row(std::span<const double> values, std::size_t rows);
std::vector<double> slopes_by_column(std::span<const double> values, std::size_t rows);

}  // namespace rheocyte
