#include "solve/newton.h"

#include <cmath>
#include <utility>

#include "solve/chord_mixing.h"

namespace rheocyte {

namespace {

/// A full step may reduce the least det of the mesh to this fraction at most; else it is shortened.
constexpr double min_det_fraction = 0.2;
constexpr int max_halvings = 5;
/// Residuals (relative) above which an iteration is given up as diverging.
constexpr double hopeless_residual = 1e6;

/// Takes the longest step 1, 1/2, 1/4, ... that does not fold the mesh; returns whether there is one.
bool step(NonlinearSystem& system, const Media& media, const VectorXd& correction, VectorXd& x, Residual& residual) {
  const double det_before = residual.min_det;
  double fraction = 1;
  for (int i = 0; i <= max_halvings; ++i, fraction /= 2) {
    const VectorXd candidate = x + fraction * correction;
    residual = system.residual(media, candidate);
    if (residual.min_det > min_det_fraction * det_before) {
      x = candidate;
      return true;
    }
  }
  return false;
}

/// A nearly rigid cell turns round-off of its strain into stress: there is nothing left to correct when a correction
/// is as small as this (in R) while the residual is small, too.
constexpr double round_off_displacement = 1e-14, round_off_residual = 1e-6;

/// Whether chord steps are still worth their time after one that took the residual from `before` to `now`.
bool goes_on_with_chords(const NewtonOptions& options, double before, double now) {
  if (!options.chord_steps) return false;
  if (options.chord_limit == 0) return now < options.chord_reduction * before;
  return now < before && std::log(now / options.tolerance) < options.chord_limit * std::log(before / now);
}

}  // namespace

double residual_scale(NonlinearSystem& system, const Media& media) {
  return system.residual(media, system.sphere()).value.norm();
}

NewtonReport newton(NonlinearSystem& system, const Media& media, const NewtonOptions& options, VectorXd& x) {
  NewtonReport report;
  const auto is_stopped = [&options] { return options.stop && *options.stop; };
  const double scale = options.residual_scale > 0 ? options.residual_scale : residual_scale(system, media);
  bool keep = options.keep_factors;  // whether the next step is a chord step
  ChordMixing mixing(options.chord_limit > 0 ? mixed_chord_steps : 0);
  Residual residual;
  if (keep) {
    residual = system.residual(media, x);
    report.residual_history.push_back(residual.value.norm() / scale);
  }
  for (int factorisations = 0;;) {
    if (is_stopped()) return report.status = Status::stopped, report;
    if (!keep) {
      if (factorisations++ == options.iteration_limit) return report.status = Status::iteration_limit, report;
      residual = system.linearise(media, x);
      report.factored_at = x;
      mixing.forget();
      if (is_stopped()) return report.status = Status::stopped, report;
      if (!system.has_factors()) {
        report.status = residual.value.allFinite() ? Status::singular_matrix : Status::not_finite;
        return report;
      }
      if (report.residual_history.empty()) report.residual_history.push_back(residual.value.norm() / scale);
    }
    if (residual.min_det <= 0) return report.status = Status::mesh_folded, report;
    const VectorXd correction = mixing.correction(system, x, residual.value);
    if (!correction.allFinite()) return report.status = Status::not_finite, report;
    const double displacement = system.largest_displacement(correction);
    if (report.iterations++ == 0) report.first_correction = displacement;
    if (!step(system, media, correction, x, residual)) {
      if (!std::exchange(keep, false)) return report.status = Status::mesh_folded, report;
      continue;
    }

    const double before = report.residual_history.back();
    report.residual = residual.value.norm() / scale;
    report.residual_history.push_back(report.residual);
    if (!std::isfinite(report.residual)) return report.status = Status::not_finite, report;
    if (report.residual > hopeless_residual) return report.status = Status::iteration_limit, report;
    const bool at_round_off = displacement < round_off_displacement && report.residual < round_off_residual;
    if (report.residual < options.tolerance || at_round_off) return report.status = Status::converged, report;
    keep = goes_on_with_chords(options, before, report.residual);
  }
}

}  // namespace rheocyte
