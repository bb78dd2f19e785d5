#include "support/mean.hpp"

#include <boost/math/distributions/students_t.hpp>

namespace scree::examples {

double Mean::student(double freedom, double level) {
  return boost::math::quantile(boost::math::students_t{freedom}, 0.5 * (1.0 + level));
}

} // namespace scree::examples
