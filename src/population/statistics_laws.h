// Quantiles and tails of the laws that statistics follow: those of Boost, compiled once.
#pragma once

namespace rheocyte {

double normal_quantile(double probability);
double students_t_quantile(double freedom, double probability);
double chi_squared_quantile(double freedom, double probability);

/// Probability of more than |x| to either side.
double normal_beyond(double x);
double students_t_beyond(double freedom, double x);
/// The same of Student's t about a shift.
double shifted_t_beyond(double freedom, double shift, double x);

/// Probability of more.
double chi_squared_above(double freedom, double x);

}  // namespace rheocyte
