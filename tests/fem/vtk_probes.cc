// Writes what tests/fem/vtk_test.py reads with VTK: files of fields, and what the fields are at random points.
#include <fmt/format.h>

#include <fstream>
#include <random>

#include "fem/tube_fields.h"
#include "fem/vtu_file.h"
#include "fem/write_fields.h"
#include "small_channel.h"

namespace rheocyte::test {
namespace {

constexpr int probes_per_element = 3;

/// Coordinates in the element, then the place and the fields there.
class Probes {
 public:
  explicit Probes(const std::string& path) : file_(path) {}
  VectorXd random_point(int dim) {
    return VectorXd::NullaryExpr(dim, [&] { return uniform_(engine_); });
  }
  void add(int element, const VectorXd& xi, const VectorXd& values) {
    file_ << element;
    for (const auto& part : {xi, values}) {
      for (const double value : part) file_ << fmt::format(",{:.17g}", value);
    }
    file_ << "\n";
  }

 private:
  std::ofstream file_;
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> uniform_{0, 1};
};

/// Place, velocity, pressure and displacement of a state, straight from its unknowns.
VectorXd fields_at(const SmallChannel& channel, const VectorXd& state, int e, const VectorXd& xi) {
  const Discretisation& space = channel.space;
  const ReferenceElement<2>& reference = space.reference();
  const ElementUnknowns& element = space.elements()[e];
  const auto& nodes = space.nodes().of_element[e];
  const VectorXd local = local_values(element, state);
  const int n = int(nodes.size()), m = element.position_columns;
  Eigen::MatrixXd at_nodes = MatrixXd::Zero(n, 6);  // x, r, v_x, v_r, u_x, u_r
  for (int k = 0; k < n; ++k) {
    for (int c = 0; c < 2; ++c) {
      if (m > 0) at_nodes(k, 4 + c) = element.position->at_nodes[c].row(k) * local.segment(c * m, m);
      at_nodes(k, c) = space.node_points()[nodes[k]](c) + at_nodes(k, 4 + c);
      if (element.liquid) at_nodes(k, 2 + c) = local(2 * m + c * n + k);
    }
    at_nodes(k, 2) += state(space.cell_velocity());
  }
  VectorXd values(7);
  for (int c = 0; c < 6; ++c) values(c) = reference.interpolate(at_nodes.col(c), Point(xi(0), xi(1)));
  values(6) = reference.pressure_modes(Point(xi(0), xi(1))).dot(local.tail(reference.pressures()));
  return values;
}

void write_channel(const std::string& folder, int degree) {
  SmallChannel channel(0.6, degree);
  const Media media{{}, {BulkLaw::neo_hookean, 12}};
  const VectorXd state = deformed_state(channel.system, media);
  const std::string name = fmt::format("{}/channel-{}", folder, degree);
  if (!write_fields(TubeFields(channel.space, media, state, Scales{1e-6, 1, 1}), name + ".vtu")) std::abort();
  Probes probes(name + ".csv");
  for (int e = 0; e < int(channel.space.elements().size()); ++e) {
    for (int i = 0; i < probes_per_element; ++i) {
      const VectorXd xi = probes.random_point(2);
      probes.add(e, xi, fields_at(channel, state, e, xi));
    }
  }
}

/// Two curved hexahedra with a polynomial of their degree in each coordinate.
void write_hexahedra(const std::string& folder, int degree) {
  const auto place = [](int e, const Eigen::Vector3d& xi) -> Eigen::Vector3d {
    return {e + xi(0) + 0.1 * xi(1) * xi(2), xi(1) + 0.2 * xi(0) * xi(2), xi(2) + 0.1 * xi(0) * xi(1)};
  };
  const auto field = [degree](int e, const Eigen::Vector3d& xi) {
    return e + std::pow(xi(0), degree) - 2 * std::pow(xi(1), degree) * xi(0) + 3 * xi(2) * std::pow(xi(1), degree);
  };
  const int n = degree + 1;
  VtuFile file(3, degree);
  const std::string name = fmt::format("{}/hexahedra-{}", folder, degree);
  Probes probes(name + ".csv");
  for (int e = 0; e < 2; ++e) {
    MatrixXd points(n * n * n, 3), values(n * n * n, 1);
    for (int k = 0; k < points.rows(); ++k) {
      const Eigen::Vector3d xi = Eigen::Vector3d(k % n, k / n % n, k / (n * n)) / degree;
      points.row(k) = place(e, xi).transpose();
      values(k) = field(e, xi);
    }
    file.add_element(points);
    file.add_field("field", values);
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d xi = probes.random_point(3);
      VectorXd expected(4);
      expected.head<3>() = place(e, xi);
      expected(3) = field(e, xi);
      probes.add(e, xi, expected);
    }
  }
  if (!file.write(name + ".vtu")) std::abort();
}

}  // namespace
}  // namespace rheocyte::test

int main(int, char** arguments) {
  for (const int degree : {2, 4, 7}) rheocyte::test::write_channel(arguments[1], degree);
  for (const int degree : {2, 3, 4}) rheocyte::test::write_hexahedra(arguments[1], degree);
}
