// expect: any message, but there is none
#include "scree/core/error.hpp"

int main() {
  return scree::require_positive("radius", 1.0, "m") > 0.0 ? 0 : 1;
}
