// How the wall of a tube answers a singular Stokes flow at its axis (docs/theory-analytic.md, eq:reflection).
#pragma once
#include <Eigen/Core>

namespace rheocyte {

/// Moments of the wall integrals over the wave number k (eq:wall-moments), divided by c_p = 2 pi (p + 2)! / 2^(p + 3).
/// Entry j belongs to p = 2 (j + 1); the moments with odd p are not needed.
struct WallMoments {
  Eigen::ArrayXd m;     ///< int k^p / Delta dk / c_p, tends to 1 for large p
  Eigen::ArrayXd v;     ///< int k^p W / Delta dk / c_p
  double lambda_0 = 0;  ///< int (2 W - 1) / Delta dk; -1.5 lambda_0 / pi is the wall coefficient of a small sphere
};

/// Moments for p = 2, 4, ..., up to `max_p` (even, 2 .. 400); good to 1e-13.
WallMoments wall_moments(int max_p);

/// Coefficients C_m, D_m of the regular flow that the wall adds to unit coefficients A_n, B_n (eq:reflection), all in
/// units of the tube radius. Row i belongs to m = 2 (i + 1), column j to n = 2 (j + 1).
struct WallReflection {
  Eigen::ArrayXXd CA, CB, DA, DB;
};

/// The reflection of the first `functions` even functions, 1 .. 100.
WallReflection wall_reflection(int functions);

}  // namespace rheocyte
