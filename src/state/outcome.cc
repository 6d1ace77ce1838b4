#include "state/outcome.h"

#include <fmt/format.h>

#include <cmath>

#include "case/case_keys.h"
#include "laws/media.h"

namespace rheocyte {

SurfaceKind surface_kind(const Media& media) {
  const Cortex& cortex = media.cortex;
  if (cortex.bending > 0) return SurfaceKind::held;
  if (cortex.law != CortexLaw::none) return SurfaceKind::membrane;
  return cortex.tension > 0 ? SurfaceKind::held : SurfaceKind::bare;
}

namespace {

/// What keeps short waves off the surface.
std::string stabilise_it(bool can_bend) {
  return fmt::format("stabilise the surface by a little {}tension (cell.cortex.tension_mN_per_m)",
                     can_bend ? "bending stiffness (cell.cortex.bending_kBT = 1e4) or " : "");
}

}  // namespace

Status judged(Status way, const FinalState& state) {
  if (!has_state(way)) return way;
  if (state.stability_margin < 0) return Status::surface_unstable;
  return state.estimated_error > state.wanted_error ? Status::accuracy_not_reached : way;
}

std::string ways_to_stability(SurfaceKind surface, bool can_bend) {
  const std::string held = surface == SurfaceKind::held ? "" : ", or " + stabilise_it(can_bend);
  return "raise the moduli, lower flow rate or viscosity" + held + ".";
}

std::string ways_to_accuracy(std::string_view key, double estimated_error) {
  constexpr double two_digits = 0.1;
  const double unit = two_digits * std::pow(10, std::floor(std::log10(estimated_error))),
               enough = std::ceil(estimated_error / unit) * unit;
  if (enough <= std::get<Number>(case_key(key).kind).range.greatest)
    return fmt::format("ask for less, {} = {:.1e} or more.", key, enough);
  return "no accuracy can be that low: raise the moduli, or lower flow rate or viscosity.";
}

namespace {

/// Where a cortex collapses, and by what way it does not.
std::string place_of(const WeakPoint& point) {
  return fmt::format(
      "at stretches of {:.3f} along the meridian and {:.3f} around the axis, {:.2f} r0 {} the "
      "middle of the cell",
      point.meridional, point.hoop, std::abs(point.place), point.place < 0 ? "behind" : "before");
}

std::string ways_out(const LastState& last) {
  if (!last.weak_point) return ways_to_stability(last.surface, last.can_bend);
  return "raise the moduli, lower flow rate or viscosity, or choose a cortex that resists any compression "
         "(cell.cortex.law = \"neo-hookean\").";
}

/// In requested moduli; near 1 as many digits as show the difference.
std::string in_wanted_moduli(double ratio) {
  constexpr double told_by_four_digits = 1e-3;
  if (ratio == 1) return "the requested moduli";
  if (std::abs(ratio - 1) < told_by_four_digits) return "hardly more than the requested moduli";
  return fmt::format("{:.4g} times the requested moduli", ratio);
}

std::string loss_of_stability(const LastState& last) {
  if (last.weak_point)
    return "The cortex of so soft a cell loses its resistance to compression " + place_of(*last.weak_point);
  switch (last.surface) {
    case SurfaceKind::bare: return "The surface of so soft a cell wrinkles (Biot instability at the rear shoulder)";
    case SurfaceKind::membrane: return "The cortex of so soft a cell is compressed and wrinkles";
    case SurfaceKind::held: return "The surface of so soft a cell wrinkles";
  }
  return {};
}

std::string unstable_surface(const std::string& where, const LastState& last) {
  return loss_of_stability(last) + ": the smooth branch ends at " + where + "; " + ways_out(last);
}

/// Of a cell with the requested moduli, of which there was a state on some mesh.
std::string explanation_of_wanted(Status status, const LastState& last) {
  const auto& weak = last.weak_point;
  if (status == Status::surface_unstable && last.stability_margin < 0)
    return fmt::format("A shape was found, but its {} (stability_margin {:.2g}), where shapes depend on the mesh; {}",
                       weak ? "cortex has lost its resistance to compression " + place_of(*weak)
                            : "surface is beyond the limit against short wrinkles",
                       last.stability_margin, ways_out(last));
  if (status == Status::surface_unstable)
    return fmt::format("A shape was found on a coarse mesh; its {} that finer meshes do not hold it; {}",
                       weak ? "cortex has so little resistance to compression left, " + place_of(*weak) + ","
                            : "surface is so near the limit against short wrinkles",
                       ways_out(last));
  return fmt::format(
      "A shape was found on a coarse mesh, but on no finer one ({}): it is close to the end of its branch; {}",
      name(status), ways_to_stability(SurfaceKind::held, false));
}

std::string inaccurate(const LastState& last) {
  if (!std::isfinite(last.estimated_error))
    return "The shape was found, but on one mesh only, so that its error cannot be estimated; raise the moduli, or "
           "lower flow rate or viscosity.";
  return fmt::format("The shape was found, but its error is estimated at {:.1e} on the finest mesh; {}",
                     last.estimated_error, ways_to_accuracy("numerics.accuracy", last.estimated_error));
}

std::string found(const LastState& last) {
  if (last.deformation >= last.deformation_floor) return "The stationary shape was found.";
  return fmt::format(
      "The stationary shape was found; its deformation is so small that it is known within {:.0e}, not within the "
      "requested {:.1e} of its value.",
      last.wanted_error * last.deformation_floor, last.wanted_error);
}

std::string nothing_found(Status status, const LastState& last) {
  if (status == Status::stopped) return "Stopped by a signal before the first state.";
  if (status == Status::surface_unstable)
    return fmt::format("The surface of this cell wrinkles at the smallest load already; {}.",
                       stabilise_it(last.can_bend));
  return "No state was found, not even of a nearly rigid cell: the case is far outside the range of the solver; check "
         "the units of its numbers.";
}

}  // namespace

std::string explanation(const Outcome& outcome, const LastState& last) {
  if (outcome.status == Status::converged) return found(last);
  if (outcome.reached <= 0) return nothing_found(outcome.status, last);
  const std::string state =
      fmt::format("{} (deformation {:.4f})", in_wanted_moduli(1 / outcome.reached), last.deformation);
  const std::string where = last.is_coarse ? state + ", on finer meshes up to a fifth lower" : state;
  if (outcome.status == Status::accuracy_not_reached) return inaccurate(last);
  if (outcome.status == Status::stopped) return "Stopped by a signal; the last state has " + where + ".";
  if (outcome.reached >= 1) return explanation_of_wanted(outcome.status, last);
  switch (outcome.status) {
    case Status::surface_unstable:
      if (last.known_end > 1)
        return unstable_surface(fmt::format("{} (the last state kept has {})", in_wanted_moduli(last.known_end), state),
                                last);
      return unstable_surface(where, last);
    case Status::limit_point:
      return fmt::format(
          "The branch of stationary shapes turns back at {} (limit point; the last state before it has {})"
          ": softer cells deform without limit; raise the moduli above that, or lower flow rate or "
          "viscosity.",
          in_wanted_moduli(last.turning), where);
    case Status::branch_ended:
      return "The branch of stationary shapes was not followed beyond " + where +
             ", where no next state was found; raise the moduli above that, or lower flow rate or viscosity.";
    case Status::mesh_folded: return "The mesh of the liquid folds beyond " + where + "; raise the moduli above that.";
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
    case Status::error_unknown: return "error-unknown";
    case Status::stopped: return "stopped";
    case Status::no_equilibrium: return "no-equilibrium";
    case Status::covered: return "covered";
    case Status::dented: return "dented";
    case Status::limit_point: return "limit-point";
  }
  return "unknown";
}

std::optional<Status> status_named(std::string_view wanted) {
  for (Status status = Status::not_started; status <= Status::limit_point; status = Status(int(status) + 1))
    if (wanted == name(status)) return status;
  return std::nullopt;
}

}  // namespace rheocyte
