/// \brief Single rocks dropped on a plate at several speeds: restitution of their rebound.
/// \smoke --drop.drops 10 --drop.speeds 0.5,1,1.5,2,3

#include "laboratory/program.hpp"

int main(int argc, char** argv) {
  return scree::examples::experiment_program("drop_test", "Restitution of single rocks dropped on a plate.",
                                             argc, argv);
}
