#include "scree/core/linear.hpp"
#include "scree/core/random.hpp"

#include <cmath>
#include <iostream>

int main() {
  scree::Random random{1, "consumer"};
  const scree::Vector axis = random.orientation() * scree::Vector::UnitX();
  std::cout << "length of a turned unit vector: " << axis.norm() << '\n';
  return std::abs(axis.norm() - 1.0) < 1e-12 ? 0 : 1;
}
