// A stationary problem at one resolution, in whatever dimension: its system, and what is read off its unknowns.
#pragma once
#include <memory>

#include "case/problem.h"
#include "fem/nonlinear_system.h"
#include "shape/measures.h"
#include "solve/resolution.h"
#include "solve/stationary.h"

namespace rheocyte {

/// Mesh, spaces and system, which refer to each other and stay together. The problems that are given are those at hand:
/// with the media of the unknowns.
class Discrete : public std::enable_shared_from_this<Discrete> {
 public:
  /// A fit that gains less is not worth the change.
  static constexpr double worthwhile = 1.2;

  explicit Discrete(const Resolution& resolution) : resolution_(resolution) {}
  virtual ~Discrete() = default;
  Discrete(const Discrete&) = delete;
  Discrete& operator=(const Discrete&) = delete;

  const Resolution& resolution() const { return resolution_; }
  virtual NonlinearSystem& system() = 0;
  /// Of the mesh along the flow.
  virtual double half_length() const = 0;

  /// What the camera sees.
  virtual Contour contour(const Problem&, const VectorXd& unknowns) const = 0;
  double deformation(const Problem& problem, const VectorXd& unknowns) const {
    return measure(contour(problem, unknowns)).deformation;
  }
  /// Distance of the surface from its limit of stability (solve/surface_stability.h).
  virtual double stability_margin(const Problem&, const VectorXd& unknowns) const = 0;
  /// Whether the surface is beyond that limit, or seen to be.
  virtual bool is_wrinkled(const Problem&, const VectorXd& unknowns) const = 0;
  virtual StateNumbers numbers(const Problem&, const VectorXd& unknowns) const = 0;
  /// Fills in contours, surface, numbers, sizes and the writers of fields, which outlive this object; outcome, errors
  /// and counts of work are left alone.
  virtual void describe(const Problem&, const VectorXd& unknowns, StationaryState&) const = 0;

  /// The same fields in the unknowns of this resolution, from another one of the same geometry.
  virtual VectorXd transfer_from(const Discrete& other, const VectorXd& unknowns) const = 0;
  /// The same, with the liquid's fields at the same places in space if the meshes round the same cell differ.
  virtual VectorXd carry_from(const Discrete& other, const VectorXd& unknowns) const = 0;
  /// At the same resolution with a mesh of the liquid that fits round the cell of a state. Elements on the surface are
  /// those of this one (`evenly` = 0), or are moved that part of the way to where they are even. Nothing if neither the
  /// quality of the mesh nor the evenness gains as much.
  std::shared_ptr<Discrete> fitted(const VectorXd& unknowns, double evenly, double gain = worthwhile) const;
  /// Gives meshes that are fitted so, ever more like this one, with the state's unknowns carried to them, to
  /// `accept(discrete, guess)` until it takes one.
  template <class Accept>
  bool try_fitted(const VectorXd& unknowns, const Accept& accept) const {
    for (const double evenly : {1.0, 0.3, 0.0}) {
      const auto discrete = fitted(unknowns, evenly);
      if (discrete && accept(discrete, discrete->carry_from(*this, unknowns))) return true;
    }
    return false;
  }
  /// At this resolution with a mesh that follows the cell as that of another one of the same kind of geometry; nothing
  /// if that has not been fitted.
  std::shared_ptr<Discrete> fitted_as(const Discrete& other) const;
  bool is_fitted() const { return is_fitted_; }
  /// Whether the mesh of the liquid has become much worse than it was.
  bool is_worn(const VectorXd& unknowns) const;
  /// Becomes that of another problem whose unknowns mean the same (Geometry::is_alike). The factors stay, for chord
  /// steps there.
  virtual void move_to(const Problem&) = 0;

 protected:
  /// Of the liquid's mesh: 1 where it is not distorted, 0 where it folds.
  virtual double mesh_quality(const VectorXd& unknowns) const = 0;
  /// Of the elements on the surface: 1 where they are even, or cannot be cut again.
  virtual double surface_evenness(const VectorXd& /*unknowns*/) const { return 1; }
  /// Of the same problem at the same resolution with a mesh as that of another one.
  virtual std::shared_ptr<Discrete> made_as(const Discrete& other) const = 0;
  /// With elements on the surface that are cut again (`fitted`); nothing if they cannot be.
  virtual std::shared_ptr<Discrete> cut_again(const VectorXd& /*unknowns*/, double /*evenly*/) const { return nullptr; }
  /// Moves the liquid's nodes so that the mesh fits round the cell of a state.
  virtual void fit(const VectorXd& unknowns) = 0;

 private:
  Resolution resolution_;
  bool is_fitted_ = false;
  double first_quality_ = 1;  ///< of the mesh when it was fitted
};

}  // namespace rheocyte
