/// \brief Bulk density of rock poured into a container and struck off (Coetzee et al. 2010, section 4.3).
/// \smoke --rock.size_factor 2.5 --container.radius 0.12 --container.height 0.1

#include "laboratory/program.hpp"

int main(int argc, char** argv) {
  return scree::examples::experiment_program(
      "bulk_density", "Bulk density of rock poured into a container and struck off.", argc, argv);
}
