// All fields of a state at the nodes of an element, in physical units and any dimension: what files and pictures are
// made from.
#pragma once
#include <vector>

#include "case/unit.h"
#include "fem/reference_element.h"
#include "laws/media.h"
#include "laws/tensor.h"
#include "shape/curve.h"

namespace rheocyte {

/// What an element knows of a state. Rows are nodes of the reference element, columns directions.
struct ElementState {
  bool liquid = false;
  MatrixXd rest, displacement, velocity;  ///< velocities relative to the cell
  VectorXd pressure;                      ///< in the cell above that at rest
  /// At the quadrature points, of the velocity or of the deformation; none where nothing is integrated.
  std::vector<Tensor<double>> gradients;
};

/// Of one state; media and what the state is of must outlive it.
class NodalFields {
 public:
  virtual ~NodalFields() = default;
  NodalFields(const NodalFields&) = delete;
  NodalFields& operator=(const NodalFields&) = delete;

  /// Columns, in um, m/s, Pa, 1/s; places, velocities and displacements take as many as there are dimensions. The
  /// velocity relative to the cell is w; stress, stretch and displacement u are those of the cell, shear stress and
  /// shear rate those of the liquid, 0 elsewhere.
  int x() const { return 0; }
  int v() const { return dim_; }
  int w() const { return 2 * dim_; }
  int u() const { return 3 * dim_; }
  int pressure() const { return 4 * dim_; }
  int stress() const { return pressure() + 1; }
  int shear_stress() const { return pressure() + 2; }
  int region() const { return pressure() + 3; }
  int rate() const { return pressure() + 4; }
  int stretch() const { return pressure() + 5; }
  int columns() const { return pressure() + 6; }

  /// Nodes x columns, the nodes of the reference element.
  MatrixXd of_element(int e) const;
  int elements() const { return elements_; }
  int dim() const { return dim_; }
  int degree() const { return int(to_nodes_.rows()) - 1; }
  /// In one direction: from the nodes to places in [0,1].
  MatrixXd from_nodes(const VectorXd& places) const { return lagrange_basis(degree(), places); }

 protected:
  template <class Space>
  NodalFields(const Space& space, const Media& media, const VectorXd& unknowns, const Scales& scales)
      : dim_(Space::dim),
        elements_(int(space.elements().size())),
        media_(media),
        scales_(scales),
        cell_velocity_(unknowns(space.cell_velocity())),
        at_rest_(rest_pressure(media.cortex, space.mesh().geometry().radius())),
        to_nodes_(space.reference().points_to_nodes()) {}
  virtual ElementState state_of(int e) const = 0;
  /// Values at the quadrature points carried to the nodes: the Q_p function that fits them best.
  VectorXd at_nodes(const VectorXd& at_points) const;

 private:
  void add_liquid_stress(const std::vector<Tensor<double>>& gradients, MatrixXd& fields) const;
  void add_cell_stress(const std::vector<Tensor<double>>& gradients, MatrixXd& fields) const;

  int dim_, elements_;
  const Media& media_;
  Scales scales_;
  double cell_velocity_, at_rest_;
  MatrixXd to_nodes_;  ///< from the 1D quadrature points
};

}  // namespace rheocyte
