#include "scatter.hpp"

#include <boost/math/distributions/students_t.hpp>

namespace validation {

double Mean::student(std::size_t freedom, double level) {
  const boost::math::students_t distribution{static_cast<double>(freedom)};
  return boost::math::quantile(distribution, 0.5 * (1.0 + level));
}

} // namespace validation
