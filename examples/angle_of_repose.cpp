/// \brief Angle of repose of rock: a heap below a funnel or of a lifted cylinder (Coetzee et al. 2010, section 4.5).
/// \smoke --heap.method lifted_cylinder --rock.size_factor 1.8 --tube.radius 0.17 --tube.height 0.18 --tube.lift_speed 1

#include "laboratory/program.hpp"

int main(int argc, char** argv) {
  return scree::examples::experiment_program("angle_of_repose", "Angle of repose of a heap of rock.", argc,
                                             argv);
}
