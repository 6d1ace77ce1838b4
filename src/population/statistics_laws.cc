#include "population/statistics_laws.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace rheocyte {

using boost::math::chi_squared;
using boost::math::normal;
using boost::math::students_t;

double normal_quantile(double probability) { return quantile(normal(), probability); }
double students_t_quantile(double freedom, double probability) { return quantile(students_t(freedom), probability); }
double chi_squared_quantile(double freedom, double probability) { return quantile(chi_squared(freedom), probability); }

double normal_beyond(double x) { return 2 * cdf(complement(normal(), std::abs(x))); }
double students_t_beyond(double freedom, double x) { return 2 * cdf(complement(students_t(freedom), std::abs(x))); }
double shifted_t_beyond(double freedom, double shift, double x) {
  const boost::math::non_central_t law(freedom, shift);
  return cdf(complement(law, std::abs(x))) + cdf(law, -std::abs(x));
}

double chi_squared_above(double freedom, double x) { return cdf(complement(chi_squared(freedom), x)); }

}  // namespace rheocyte
