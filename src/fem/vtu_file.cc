#include "fem/vtu_file.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <fstream>
#include <numeric>
#include <span>

namespace rheocyte {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says that its numbers are little-endian");

/// VTK's cell types VTK_LAGRANGE_QUADRILATERAL and VTK_LAGRANGE_HEXAHEDRON.
constexpr std::uint8_t lagrange_quadrilateral = 70, lagrange_hexahedron = 72;

/// Arrays of bytes behind the XML, each after its length.
class Appended {
 public:
  template <class Number>
  std::string add(std::span<const Number> values) {
    std::string place = " format=\"appended\" offset=\"" + std::to_string(bytes_) + "\"";
    blocks_.push_back(std::as_bytes(values));
    bytes_ += sizeof(std::uint64_t) + values.size_bytes();
    return place;
  }
  void write(std::ostream& file) const {
    for (const auto block : blocks_) {
      const std::uint64_t size = block.size();
      file.write(reinterpret_cast<const char*>(&size), sizeof size);
      file.write(reinterpret_cast<const char*>(block.data()), std::streamsize(block.size()));
    }
  }

 private:
  std::vector<std::span<const std::byte>> blocks_;
  std::size_t bytes_ = 0;
};

/// Corners go round the quadrilateral; edges and faces run with the coordinates.
int number_in_quadrilateral(int i, int j, int p) {
  const bool i_end = i == 0 || i == p, j_end = j == 0 || j == p;
  if (i_end && j_end) return i ? (j ? 2 : 1) : (j ? 3 : 0);
  const int inner = p - 1;
  if (j_end) return 4 + (j ? 2 * inner : 0) + i - 1;
  if (i_end) return 4 + (i ? inner : 3 * inner) + j - 1;
  return 4 * p + (j - 1) * inner + i - 1;
}

int number_in_hexahedron(int i, int j, int k, int p) {
  const bool i_end = i == 0 || i == p, j_end = j == 0 || j == p, k_end = k == 0 || k == p;
  const int inner = p - 1, ends = i_end + j_end + k_end;
  if (ends == 3) return number_in_quadrilateral(i, j, p) + (k ? 4 : 0);
  if (ends == 2) {
    if (k_end) return number_in_quadrilateral(i, j, p) + 4 + (k ? 4 * inner : 0);
    return 8 + 8 * inner + number_in_quadrilateral(i, j, p) * inner + k - 1;
  }
  const int faces = 8 + 12 * inner, face = inner * inner;
  if (ends == 0) return faces + 6 * face + ((k - 1) * inner + j - 1) * inner + i - 1;
  if (i_end) return faces + (i ? face : 0) + (k - 1) * inner + j - 1;
  if (j_end) return faces + (j ? 3 : 2) * face + (k - 1) * inner + i - 1;
  return faces + (k ? 5 : 4) * face + (j - 1) * inner + i - 1;
}

std::string data_array(const std::string& name, const char* type, int components, const std::string& place) {
  return "<DataArray Name=\"" + name + "\" type=\"" + type + "\" NumberOfComponents=\"" + std::to_string(components) +
         "\"" + place + "/>\n";
}

}  // namespace

std::vector<int> vtk_node_order(int dim, int degree) {
  assert(dim == 2 || dim == 3);
  std::vector<int> order;
  for (int k = 0; k <= (dim == 3 ? degree : 0); ++k) {
    for (int j = 0; j <= degree; ++j) {
      for (int i = 0; i <= degree; ++i)
        order.push_back(dim == 2 ? number_in_quadrilateral(i, j, degree) : number_in_hexahedron(i, j, k, degree));
    }
  }
  return order;
}

void VtuFile::append(const Eigen::MatrixXd& values, Array& array) const {
  assert(values.rows() == Eigen::Index(order_.size()));
  const std::size_t first = array.values.size();
  array.values.resize(first + order_.size() * array.components, 0.0);
  for (std::size_t node = 0; node < order_.size(); ++node) {
    for (Eigen::Index c = 0; c < values.cols(); ++c)
      array.values[first + order_[node] * array.components + c] = values(Eigen::Index(node), c);
  }
}

void VtuFile::add_element(const Eigen::MatrixXd& points) {
  append(points, points_);
  ++elements_;
}

void VtuFile::add_field(const std::string& name, const Eigen::MatrixXd& values) {
  auto field = std::find_if(fields_.begin(), fields_.end(), [&](const Array& known) { return known.name == name; });
  if (field == fields_.end()) field = fields_.insert(fields_.end(), {name, values.cols() == 1 ? 1 : 3, {}});
  append(values, *field);
}

bool VtuFile::write(const std::string& path) const {
  const std::size_t nodes = order_.size(), points = nodes * elements_;
  std::vector<std::int64_t> connectivity(points), offsets(elements_);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  for (int e = 0; e < elements_; ++e) offsets[e] = std::int64_t(nodes) * (e + 1);
  const std::vector<std::uint8_t> types(elements_, dim_ == 2 ? lagrange_quadrilateral : lagrange_hexahedron);

  Appended appended;
  const auto numbers = [&](const Array& array) {
    return data_array(array.name, "Float64", array.components, appended.add(std::span(array.values)));
  };
  // From version 2.2 on VTK numbers the edges of hexahedra as here.
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
      std::to_string(points) + "\" NumberOfCells=\"" + std::to_string(elements_) + "\">\n";
  text += "<Points>\n" + numbers(points_) + "</Points>\n<Cells>\n";
  text += data_array("connectivity", "Int64", 1, appended.add(std::span<const std::int64_t>(connectivity)));
  text += data_array("offsets", "Int64", 1, appended.add(std::span<const std::int64_t>(offsets)));
  text += data_array("types", "UInt8", 1, appended.add(std::span<const std::uint8_t>(types)));
  text += "</Cells>\n<PointData>\n";
  for (const Array& field : fields_) text += numbers(field);
  text += "</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

  std::ofstream file(path, std::ios::binary);
  file << text;
  appended.write(file);
  file << "\n</AppendedData>\n</VTKFile>\n";
  file.flush();
  return file.good();
}

}  // namespace rheocyte
