/// \brief Density of solid rock: a batch weighed in air and in water.
/// \smoke --batch.grains 100

#include "laboratory/program.hpp"

int main(int argc, char** argv) {
  return scree::examples::experiment_program(
      "immersion", "Density of solid rock, weighed in air and in water.", argc, argv);
}
