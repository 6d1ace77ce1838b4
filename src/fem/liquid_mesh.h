// The mesh of a space's liquid at a low degree, at which it is fitted, and the way from and to the space's own.
#pragma once
#include <utility>

#include "fem/fitted_mesh.h"
#include "fem/node_numbers.h"
#include "fem/tensor_tangent.h"

namespace rheocyte {

/// An element of the liquid: its number, and places of its nodes, in rows.
struct LiquidElement {
  int number;
  MatrixXd now;   ///< those of the space's degree
  MatrixXd rest;  ///< those of the lower degree, round the undeformed cell
};

template <int dim>
class LiquidMesh {
 public:
  /// `reference` is of the lower degree and must outlive this object, `numbers` are those of all nodes at this degree.
  LiquidMesh(const ReferenceElement<dim>& own, const ReferenceElement<dim>& reference, NodeNumbers numbers,
             std::vector<LiquidElement> elements)
      : numbers_(std::move(numbers)),
        elements_(std::move(elements)),
        up_(reference.lagrange(own.nodes_1d)),
        mesh_{reference, {}, MatrixXd::Zero(numbers_.count, dim), {}, 0},
        places_(MatrixXd::Zero(numbers_.count, dim)) {
    const MatrixXd down = own.lagrange(reference.nodes_1d);
    for (const LiquidElement& element : elements_) {
      const auto& nodes = mesh_.elements.emplace_back(numbers_.of_element[std::size_t(element.number)]);
      mesh_.rest(nodes, Eigen::all) = element.rest;
      places_(nodes, Eigen::all) = at_other_nodes<dim>(down, element.now);
    }
  }

  /// Numbers the components of places that may move: `free(place at rest)` gives which may, and which move with the one
  /// before. Those of the cell are held.
  enum class Component { held, free, tied };
  template <class Free>
  void number_components(const Free& free) {
    std::vector<bool> is_liquid(numbers_.of_element.size(), false), is_of_cell(std::size_t(numbers_.count), false);
    for (const LiquidElement& element : elements_) is_liquid[std::size_t(element.number)] = true;
    for (std::size_t e = 0; e < is_liquid.size(); ++e) {
      for (const int node : numbers_.of_element[e])
        if (!is_liquid[e]) is_of_cell[std::size_t(node)] = true;
    }
    for (int i = 0; i < numbers_.count; ++i) {
      auto& unknown = mesh_.unknown.emplace_back();
      unknown.fill(-1);
      if (is_of_cell[std::size_t(i)]) continue;
      const std::array<Component, dim> components = free(Eigen::Matrix<double, dim, 1>(mesh_.rest.row(i).transpose()));
      for (std::size_t c = 0; c < dim; ++c) {
        if (components[c] == Component::free) unknown[c] = mesh_.unknowns++;
        if (components[c] == Component::tied) unknown[c] = unknown[c - 1];
      }
    }
  }

  double quality() const { return mesh_quality(mesh_, places_); }

  /// Calls visit(element, moves of its nodes at the space's degree) with the least distorted mesh.
  template <class Visit>
  void fit(const Visit& visit) const {
    const MatrixXd moves = fitted_places(mesh_, places_) - places_;
    for (const LiquidElement& element : elements_) {
      const auto& nodes = numbers_.of_element[std::size_t(element.number)];
      visit(element.number, at_other_nodes<dim>(up_, moves(nodes, Eigen::all)));
    }
  }

 private:
  NodeNumbers numbers_;
  std::vector<LiquidElement> elements_;
  MatrixXd up_;  ///< from the lower degree: nodes x nodes in one direction
  MovableMesh<dim> mesh_;
  MatrixXd places_;
};

}  // namespace rheocyte
