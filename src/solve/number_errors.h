// How far off the numbers of a state are: each has an error of its own (docs/theory.md, eq:error).
#pragma once
#include <span>

#include "state/state_measures.h"

namespace rheocyte {

/// Error of the last of some values of a number on ever finer resolutions (docs/theory.md, eq:error): the last change
/// times the rest of a geometric series, and half of the last change and a fraction of the one before at least; of two
/// values twice their difference. In the number's unit; infinite for a single value.
double error_of_last(std::span<const double> values, double fraction_of_change_before = 0.5);

/// Root mean square change of the modes of the outline's radius.
double change_of_outline(const StateNumbers&, const StateNumbers&);

/// Numbers of which none is known.
StateNumbers unknown_numbers();

/// Errors of the numbers of the last of some states of a cell on ever finer resolutions, each in its number's unit;
/// that of the deformation, relative, is known. Two resolutions may agree in one number by chance, but hardly in all:
/// no error is below the change of the outline, nor, of a number at single points, far below the greatest change of
/// such (docs/theory.md, eq:number-errors). Not a number where there is no number, or no error is known.
StateNumbers errors_of_last(std::span<const StateNumbers>, double error_of_deformation);

/// Errors of the numbers of a state of which another one with greater errors is known, each in its number's unit: the
/// changes between them, and none below those of the outline, which changes by `min_outline` at least, or of
/// single points.
StateNumbers errors_of_change(const StateNumbers& coarser, const StateNumbers&, double min_outline = 0);

/// Magnitudes of the differences, number by number.
StateNumbers distance(const StateNumbers&, const StateNumbers&);

/// Takes the greater of two errors of each number; those that are not known stay so.
void take_greater(const StateNumbers& others, StateNumbers& errors);

/// Adds a multiple of errors to errors; what is not known of either is not of the sum.
void add_errors(double factor, const StateNumbers& more, StateNumbers& errors);

}  // namespace rheocyte
