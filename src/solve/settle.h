// A state that was carried to another mesh settles there (docs/theory.md, eq:fading-load).
#pragma once
#include "solve/continuation.h"

namespace rheocyte {

/// From unknowns that are nearly a state, but too far from it for Newton's method: a load that balances them fades to
/// nothing. The report's last unknowns are the state, its parameter the fraction of the load that has faded.
ContinuationReport settle(NonlinearSystem&, const Media&, VectorXd guess, const NewtonOptions&);

/// Newton's method; where it misses, `settle`. The report is that of both.
NewtonReport newton_or_settle(NonlinearSystem&, const Media&, const NewtonOptions&, VectorXd& unknowns);

}  // namespace rheocyte
