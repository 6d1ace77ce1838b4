// Fields of a state as a picture needs them: values at points that straight triangles connect, in physical units.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace rheocyte {

/// In the half-plane (x along the flow, r from the axis) that a camera looks at; points on the cell's surface stand
/// twice, for the liquid and for the cell. Where a field has no meaning it is 0.
struct SampledFields {
  using Vectors = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;
  using Numbers = Eigen::VectorXf;

  Vectors point_um;
  Vectors velocity_m_per_s;  ///< relative to the cell
  Vectors displacement_um;   ///< of the cell
  Numbers pressure_Pa;
  Numbers shear_rate_per_s;  ///< of the liquid, sqrt(2 D:D)
  Numbers stress_Pa;         ///< von Mises, elastic
  Numbers stretch;           ///< greatest principal stretch of the cell
  std::vector<std::uint8_t> in_cell;
  std::vector<std::uint32_t> triangles;  ///< three points each

  /// In a square channel the whole surface of the cell.
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> surface_um;
  std::vector<std::uint32_t> surface_triangles;
};

/// So many divisions of each quadrilateral make about so many points of all.
int sampling_divisions(int points, std::size_t quadrilaterals);
/// From the nodes of a quadrilateral to a grid, first coordinate fastest, by the values of the functions of one
/// direction: points x nodes.
Eigen::MatrixXd sampling_grid(const Eigen::MatrixXd& basis);

/// A grid of (divisions + 1)^2 points, first coordinate fastest, as triangles; the first point has this number.
void add_grid_triangles(std::uint32_t first, int divisions, std::vector<std::uint32_t>& triangles);

}  // namespace rheocyte
