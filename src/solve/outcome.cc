#include "solve/outcome.h"

#include <fmt/format.h>

#include <cmath>

namespace rheocyte {

SurfaceKind surface_kind(const Problem& problem) {
  const Cortex& cortex = problem.cortex;
  if (cortex.bending > 0) return SurfaceKind::held;
  if (cortex.law != CortexLaw::none) return SurfaceKind::membrane;
  return cortex.tension > 0 ? SurfaceKind::held : SurfaceKind::bare;
}

namespace {

/// What keeps short waves off the surface.
constexpr std::string_view stabiliser =
    "a little bending stiffness (cell.cortex.bending_kBT = 1e4) or tension (cell.cortex.tension_mN_per_m)";

std::string unstable_surface(const std::string& where, const LastState& last) {
  const std::string what = last.surface == SurfaceKind::membrane
                               ? "The cortex of so soft a cell is compressed and wrinkles: the smooth branch ends at "
                               : "The surface of so soft a cell wrinkles (Biot instability at the rear shoulder): the "
                                 "smooth branch ends at ";
  const bool can_be_held = last.surface != SurfaceKind::held && last.can_have_cortex;
  return what + where + "; raise the moduli above that, lower flow rate or viscosity" +
         (can_be_held ? fmt::format(", or stabilise the surface by {}.", stabiliser) : ".");
}

}  // namespace

std::string explanation(const Outcome& outcome, const LastState& last) {
  if (outcome.status == Status::converged && last.estimated_error > last.wanted_error)
    return fmt::format(
        "The stationary shape was found; its deformation is so small that rounding limits it: it is known within "
        "{:.0e}, "
        "not within the wanted {:.1e} of its value.",
        deformation_round_off, last.wanted_error);
  if (outcome.status == Status::converged) return "The stationary shape was found.";
  if (outcome.status == Status::stopped && outcome.reached <= 0) return "Stopped by a signal before the first state.";
  if (outcome.reached <= 0) {
    if (outcome.status == Status::surface_unstable)
      return fmt::format("The surface of this cell wrinkles at the smallest load already; {}.",
                         last.can_have_cortex ? fmt::format("stabilise it by {}", stabiliser)
                                              : std::string("raise the moduli, or lower flow rate or viscosity"));
    return "No state was found, not even of a nearly rigid cell: the case is far outside what the solver can follow; "
           "check the units of its numbers.";
  }
  const std::string state =
      fmt::format("{:.4g} times the wanted moduli (deformation {:.4f})", 1 / outcome.reached, last.deformation);
  const std::string where = last.is_coarse ? state + ", on finer meshes up to a fifth lower" : state;
  switch (outcome.status) {
    case Status::surface_unstable:
      if (last.known_end > 0)
        return unstable_surface(
            fmt::format("{:.4g} times the wanted moduli (the last state kept has {})", last.known_end, state), last);
      return unstable_surface(where, last);
    case Status::branch_ended:
      return "The branch of stationary shapes ends at " + where +
             "; softer cells are drawn out without limit: raise the moduli above that, or lower flow rate or "
             "viscosity.";
    case Status::mesh_folded: return "The mesh of the liquid folds beyond " + where + "; raise the moduli above that.";
    case Status::accuracy_not_reached:
      if (!std::isfinite(last.estimated_error))
        return "The shape was found, but on one mesh only, so that its error cannot be estimated; raise the moduli, or "
               "lower flow rate or viscosity.";
      return fmt::format(
          "The shape was found, but its error is estimated at {:.1e} on the finest mesh; ask for less, "
          "numerics.accuracy above that.",
          last.estimated_error);
    case Status::stopped: return "Stopped by a signal; the last state has " + where + ".";
    default: return fmt::format("The solver stopped ({}) at ", name(outcome.status)) + where + ".";
  }
}

const char* name(Status status) {
  switch (status) {
    case Status::not_started: return "not-started";
    case Status::converged: return "converged";
    case Status::iteration_limit: return "iteration-limit";
    case Status::mesh_folded: return "mesh-folded";
    case Status::surface_unstable: return "surface-unstable";
    case Status::branch_ended: return "branch-ended";
    case Status::singular_matrix: return "singular-matrix";
    case Status::not_finite: return "not-finite";
    case Status::accuracy_not_reached: return "accuracy-not-reached";
    case Status::stopped: return "stopped";
    case Status::no_equilibrium: return "no-equilibrium";
    case Status::covered: return "covered";
    case Status::dented: return "dented";
  }
  return "unknown";
}

std::optional<Status> status_named(std::string_view wanted) {
  for (Status status = Status::not_started; status <= Status::dented; status = Status(int(status) + 1))
    if (wanted == name(status)) return status;
  return std::nullopt;
}

}  // namespace rheocyte
