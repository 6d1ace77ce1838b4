#include "fem/fitted_mesh.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>
#include <optional>

#include "laws/derivative.h"
#include "laws/mesh_form.h"

namespace rheocyte {
namespace {

/// Steps of Newton's method, and the decrease of the distortion, relative to it, that ends them: a mesh need not be the
/// best one.
constexpr int max_steps = 20;
constexpr double worthwhile_decrease = 1e-3;
constexpr int max_halvings = 10;
/// Shifts of a Hessian's diagonal, relative to it, until it is positive definite.
constexpr double shifts[] = {0, 1e-3, 1e-2, 0.1, 1, 10, 100, 1e3};

template <int dim>
using Square = Eigen::Matrix<double, dim, dim>;

/// The map of an element at its quadrature points, d(place)/d(xi).
template <int dim>
std::vector<Square<dim>> maps(const MovableMesh<dim>& mesh, int element, const MatrixXd& places) {
  const MatrixXd nodal = places(mesh.elements[element], Eigen::all);
  std::vector<Square<dim>> G(mesh.reference.points());
  for (int k = 0; k < dim; ++k) {
    const MatrixXd slope = mesh.reference.shape.slope[k] * nodal;
    for (std::size_t q = 0; q < G.size(); ++q) G[q].col(k) = slope.row(Eigen::Index(q)).transpose();
  }
  return G;
}

/// Distortion at a point as a function of the map there.
template <int dim>
struct PointDistortion {
  Square<dim> to_rest;  ///< inverse of the map at rest

  template <class T>
  T operator()(const std::array<T, std::size_t(dim) * dim>& by_columns) const {
    const Matrix<T, dim, dim> G(by_columns);
    Matrix<T, dim, dim> F;
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) {
        F(i, j) = G(i, 0) * constant<T>(to_rest(0, j));
        for (int k = 1; k < dim; ++k) F(i, j) += G(i, k) * constant<T>(to_rest(k, j));
      }
    }
    return distortion(F);
  }
};

/// The sum of the distortion over the elements, all of which count alike, and its derivatives.
template <int dim>
class Distortion {
 public:
  static constexpr int numbers = dim * dim;
  using Numbers = std::array<double, std::size_t(numbers)>;

  explicit Distortion(const MovableMesh<dim>& mesh) : mesh_(mesh) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      auto& of_element = points_.emplace_back();
      for (const Square<dim>& G : maps(mesh, int(e), mesh.rest)) of_element.push_back({G.inverse()});
    }
  }

  /// The greatest one at a point; infinite where the mesh is folded.
  double worst(const MatrixXd& places) const {
    double worst = 0;
    visit(places, [&](int, int, double value) { worst = std::max(worst, value); });
    return worst;
  }

  double value(const MatrixXd& places) const {
    double sum = 0;
    visit(places, [&](int, int q, double value) { sum += mesh_.reference.weights(q) * value; });
    return sum;
  }

  /// Gradient and Hessian with respect to the unknowns.
  void derive(const MatrixXd& places, VectorXd& gradient, Eigen::SparseMatrix<double>& hessian) const {
    gradient = VectorXd::Zero(mesh_.unknowns);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) add_element(int(e), places, gradient, entries);
    hessian.resize(mesh_.unknowns, mesh_.unknowns);
    hessian.setFromTriplets(entries.begin(), entries.end());
  }

 private:
  static Numbers by_columns(const Square<dim>& G) {
    Numbers numbers_of;
    std::copy(G.data(), G.data() + numbers, numbers_of.begin());
    return numbers_of;
  }

  template <class Visitor>
  void visit(const MatrixXd& places, const Visitor& on) const {
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      const auto G = maps(mesh_, int(e), places);
      for (std::size_t q = 0; q < G.size(); ++q) {
        const bool folds = !(G[q].determinant() * points_[e][q].to_rest.determinant() > 0);
        on(int(e), int(q), folds ? std::numeric_limits<double>::infinity() : points_[e][q](by_columns(G[q])));
      }
    }
  }

  void add_element(int e, const MatrixXd& places, VectorXd& gradient,
                   std::vector<Eigen::Triplet<double>>& entries) const {
    const auto& nodes = mesh_.elements[e];
    const ReferenceElement<dim>& reference = mesh_.reference;
    const Eigen::Index n = Eigen::Index(nodes.size());
    VectorXd of_nodes = VectorXd::Zero(dim * n);
    MatrixXd hessian = MatrixXd::Zero(dim * n, dim * n);
    const auto G = maps(mesh_, e, places);
    for (std::size_t q = 0; q < G.size(); ++q) {
      using First = Dual<double, numbers>;
      std::array<First, std::size_t(numbers)> inputs = independent(by_columns(G[q]));
      const auto [value, slopes] = value_and_slopes(points_[e][q], inputs);
      // Number i + dim * k of the map is the derivative of component i by xi_k.
      MatrixXd shape(dim, n);
      for (int k = 0; k < dim; ++k) shape.row(k) = reference.shape.slope[k].row(Eigen::Index(q));
      const double weight = reference.weights(Eigen::Index(q));
      for (int i = 0; i < dim; ++i) {
        Eigen::RowVectorXd by_map(dim);
        for (int k = 0; k < dim; ++k) by_map(k) = slopes[std::size_t(i + dim * k)].value;
        of_nodes.segment(i * n, n) += weight * (by_map * shape).transpose();
        for (int j = 0; j < dim; ++j) {
          Square<dim> second;
          for (int k = 0; k < dim; ++k) {
            for (int l = 0; l < dim; ++l) second(k, l) = slopes[std::size_t(i + dim * k)].slope(j + dim * l);
          }
          hessian.block(i * n, j * n, n, n) += weight * (shape.transpose() * second * shape);
        }
      }
    }
    for (Eigen::Index a = 0; a < dim * n; ++a) {
      const int row = mesh_.unknown[nodes[a % n]][std::size_t(a / n)];
      if (row < 0) continue;
      gradient(row) += of_nodes(a);
      for (Eigen::Index b = 0; b < dim * n; ++b) {
        const int column = mesh_.unknown[nodes[b % n]][std::size_t(b / n)];
        if (column >= 0 && column <= row) entries.emplace_back(row, column, hessian(a, b));
      }
    }
  }

  const MovableMesh<dim>& mesh_;
  std::vector<std::vector<PointDistortion<dim>>> points_;
};

/// Newton's step, or, where the Hessian is not positive definite, one towards steepest descent.
std::optional<VectorXd> descent(const VectorXd& gradient, const Eigen::SparseMatrix<double>& hessian) {
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factors;
  factors.analyzePattern(hessian);
  const VectorXd diagonal = hessian.diagonal().cwiseAbs();
  for (const double shift : shifts) {
    Eigen::SparseMatrix<double> shifted = hessian;
    shifted.diagonal() += shift * diagonal;
    factors.factorize(shifted);
    if (factors.info() == Eigen::Success) return VectorXd(factors.solve(-gradient));
  }
  return {};
}

template <int dim>
MatrixXd moved(const MovableMesh<dim>& mesh, MatrixXd places, const VectorXd& step, double fraction) {
  for (std::size_t i = 0; i < mesh.unknown.size(); ++i) {
    for (int c = 0; c < dim; ++c) {
      const int unknown = mesh.unknown[i][std::size_t(c)];
      if (unknown >= 0) places(Eigen::Index(i), c) += fraction * step(unknown);
    }
  }
  return places;
}

}  // namespace

template <int dim>
double mesh_quality(const MovableMesh<dim>& mesh, const MatrixXd& places) {
  return 1 / Distortion<dim>(mesh).worst(places);
}

template <int dim>
MatrixXd fitted_places(const MovableMesh<dim>& mesh, MatrixXd places) {
  const Distortion<dim> distortion(mesh);
  double now = distortion.value(places);
  VectorXd gradient;
  Eigen::SparseMatrix<double> hessian;
  for (int i = 0; i < max_steps && std::isfinite(now); ++i) {
    distortion.derive(places, gradient, hessian);
    const std::optional<VectorXd> step = descent(gradient, hessian);
    if (!step) break;
    const double before = now;
    double fraction = 1;
    for (int k = 0; k <= max_halvings; ++k, fraction /= 2) {
      MatrixXd candidate = moved(mesh, places, *step, fraction);
      const double then = distortion.value(candidate);
      if (!(then < now)) continue;
      places = std::move(candidate);
      now = then;
      break;
    }
    if (before - now < worthwhile_decrease * before) break;
  }
  return places;
}

template double mesh_quality(const MovableMesh<2>&, const MatrixXd&);
template double mesh_quality(const MovableMesh<3>&, const MatrixXd&);
template MatrixXd fitted_places(const MovableMesh<2>&, MatrixXd);
template MatrixXd fitted_places(const MovableMesh<3>&, MatrixXd);

}  // namespace rheocyte
