/// \brief Rocks on a plate or a layer in a tray, tilted until they move.
/// \smoke --tilt.rocks 6 --tilt.rate 10 --tilt.steepest 30

#include "laboratory/program.hpp"

int main(int argc, char** argv) {
  return scree::examples::experiment_program(
      "tilt_test", "Angle at which rock on a plate or in a tray moves.", argc, argv);
}
