// A VTU file (VTK's unstructured grid) of high-order quadrilaterals or hexahedra, for ParaView and for the pictures.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace rheocyte {

/// VTK's number of each node of a Lagrange quadrilateral or hexahedron of a degree; nodes first coordinate fastest.
std::vector<int> vtk_node_order(int dim, int degree);

/// Elements of one degree, each with nodes of its own, so that fields may jump between them.
class VtuFile {
 public:
  /// Elements of dimension 2 or 3.
  VtuFile(int dim, int degree) : dim_(dim), order_(vtk_node_order(dim, degree)) {}

  /// Adds an element by the places of its equidistant nodes: nodes x dim, first coordinate fastest. Its fields follow
  /// at once, in the same order of nodes; all elements have the same fields.
  void add_element(const Eigen::MatrixXd& points);
  /// Values of the last element: nodes x 1, or nodes x dim for a vector.
  void add_field(const std::string& name, const Eigen::MatrixXd& values);

  /// False if the file cannot be written.
  bool write(const std::string& path) const;

 private:
  struct Array {
    std::string name;
    int components = 1;
    std::vector<double> values;  ///< point by point
  };
  void append(const Eigen::MatrixXd& values, Array&) const;

  int dim_;
  std::vector<int> order_;
  int elements_ = 0;
  Array points_{"Points", 3, {}};
  std::vector<Array> fields_;
};

}  // namespace rheocyte
