// How a computation ended: a value, never an exception and never a log line.
#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace rheocyte {

struct Media;

/// Why the solver stopped. Starts as `not_started`: success has to be said, never assumed.
enum class Status {
  not_started,
  converged,
  iteration_limit,       ///< Newton did not converge although the continuation step was reduced to its least value
  mesh_folded,           ///< the liquid's mesh overlaps itself at every step size
  surface_unstable,      ///< the surface wrinkles, or its cortex collapses: the branch ends before the requested state
  branch_ended,          ///< no next state was found, for whatever reason
  singular_matrix,       ///< the factorisation failed
  not_finite,            ///< NaN or infinity in residual or state
  accuracy_not_reached,  ///< converged on every mesh that was tried, but the error estimate stays above the requested
                         ///< one
  error_unknown,         ///< the state was found; a signal stopped the computation of its error
  stopped,               ///< by a signal
  no_equilibrium,        ///< the cell drifts on to the wall
  covered,               ///< of a table's branch: it leaves the table's ranges
  dented,                ///< of a table's branch: the dent at the rear is as deep as the table admits
  limit_point,           ///< the branch turns back: it was followed round the fold, beyond which it has no state
};

/// Whether there is a state, be it less accurate than requested.
inline bool has_state(Status status) {
  return status == Status::converged || status == Status::accuracy_not_reached || status == Status::error_unknown;
}

/// What a state that was found is judged by.
struct FinalState {
  double stability_margin = 1;     ///< below 0: beyond the limit against short wrinkles (solve/surface_stability.h)
  double estimated_error = 0;      ///< relative; NaN: not known
  double wanted_error = HUGE_VAL;  ///< HUGE_VAL: none is requested
};

/// The status of a state, from how the way to it ended and from what the state is: none is `converged` whose surface is
/// beyond its limit or whose stated error is above the requested one. Tube, duct and time ask here.
Status judged(Status way, const FinalState&);

/// What happened to the user's case.
struct Outcome {
  Status status = Status::not_started;
  std::string message;  ///< one sentence: what, at which value, what to try
  double reached = 0;   ///< fraction of the requested compliance 1/E that was reached, 1: the requested moduli
};

/// Whether there is a shape with the requested moduli, be its surface beyond the limit of stability.
inline bool has_wanted_moduli(const Outcome& outcome) {
  return has_state(outcome.status) || (outcome.status == Status::surface_unstable && outcome.reached >= 1);
}

/// What keeps wrinkles off. bare: the bulk alone; loses stability at Biot's ratio. membrane: an elastic cortex without
/// bending stiffness; it does where it is compressed along the meridian more than the bulk below supports. held: by
/// tension without a cortex, or by bending stiffness; short wrinkles do not grow, but a cortex may still collapse.
enum class SurfaceKind { bare, membrane, held };
SurfaceKind surface_kind(const Media&);

/// The absolute error that rounding leaves of a deformation: the digits of area and perimeter cancel. No deformation is
/// resolved better, whatever relative accuracy is requested.
inline constexpr double deformation_round_off = 1e-12;

/// A point of the surface at which a cortex loses its resistance to compression.
struct WeakPoint {
  double meridional = 1, hoop = 1;  ///< stretches
  double place = 0;                 ///< along the flow from the middle of the cell, in its undeformed radius
};

/// What an explanation speaks of.
struct LastState {
  double deformation = 0;
  double deformation_floor = 0;  ///< errors of smaller deformations are relative to this
  double estimated_error = 0;    ///< relative
  double wanted_error = 0;       ///< relative
  double stability_margin = 1;
  SurfaceKind surface = SurfaceKind::bare;
  std::optional<WeakPoint> weak_point = {};  ///< if the surface loses its stability by collapse, not by wrinkles
  bool can_bend = true;                      ///< not off the axis of a duct
  bool is_coarse = false;                    ///< the end was seen on coarse meshes alone
  double known_end = 0;                      ///< least modulus over the requested one, where it was known beforehand
  double turning = 0;                        ///< the same at the fold of a branch that turns
};

/// One sentence for the user: what happened, where, what to try.
std::string explanation(const Outcome&, const LastState&);

/// The end of a sentence on a surface beyond its limit: "raise the moduli ... ."
std::string ways_to_stability(SurfaceKind, bool can_bend);
/// The end of a sentence on a relative error above that of a key ("numerics.accuracy"), as far as the key takes it.
std::string ways_to_accuracy(std::string_view key, double estimated_error);

/// The stable name that stands in result.json, e.g. "converged", "surface-unstable".
const char* name(Status);
/// The one with that name.
std::optional<Status> status_named(std::string_view);

}  // namespace rheocyte
