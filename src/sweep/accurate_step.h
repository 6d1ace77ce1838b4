// How far apart the samples of a branch may be, by the samples themselves.
#pragma once
#include <span>

namespace rheocyte {

/// What a sample of a branch shows of the number by which the branch is sampled.
struct SamplePoint {
  double place = 0;  ///< ln(compliance)
  double value = 0;  ///< ln(number)
  double slope = 0;  ///< d(value)/d(place)
};

/// The number grows with this power of the compliance at first; polynomials run through what is left.
struct InitialGrowth {
  double power = 0;
};

/// The largest step in ln(compliance) from the last but one of at least three samples, at most `limit`, behind which
/// the dense output (SampledBranch) errs by no more than `wanted` in the value. The derivative to which the error is
/// proportional is that which shows how far this sample is from the polynomial through those around it. As this may
/// vanish by chance, polynomials through one sample less are looked at, too; if they are far off, the step is somewhat
/// smaller than that to the last sample.
double accurate_step(std::span<const SamplePoint>, InitialGrowth, double wanted, double limit);

}  // namespace rheocyte
