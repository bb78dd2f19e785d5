/// \brief Confined compression of rock in a cylinder: load and displacement over a few cycles (Coetzee et al. 2010, section 4.4).
/// \smoke --rock.size_factor 2.5 --container.radius 0.12 --container.height 0.08 --load.cycles 2 --load.strain_rate 1 --load.most_inertial_number 1 --load.points 50

#include "laboratory/program.hpp"

int main(int argc, char** argv) {
  return scree::examples::experiment_program("oedometer", "Confined compression of rock in a cylinder.", argc,
                                             argv);
}
