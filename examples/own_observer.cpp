/// \brief An observer of your own: the coordination number of a bed as it settles
/// \smoke
#include "scree/packing/loose_lattice.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <cstdio>
#include <functional>
#include <vector>

using namespace scree;

/// Mean number of contacts of the grains that bear load, counted as those with three or more. Any callable
/// that takes the simulation is an observer; this one also keeps its last result.
struct CoordinationNumber {
  double mean = 0.0;

  template <class Simulation>
  void operator()(const Simulation& sim) {
    std::vector<int> contacts(sim.bodies().size(), 0);
    sim.visit_contacts([&](const ContactView& contact) {
      ++contacts[contact.first];
      if (!contact.with_wall) {
        ++contacts[contact.second];
      }
    });
    std::size_t bearing = 0;
    mean = 0.0;
    for (const int count : contacts) {
      if (count >= 3) {
        mean += (count - mean) / static_cast<double>(++bearing);
      }
    }
    std::printf("%.2f s: %4zu of %zu grains bear load, with %.2f contacts each\n", sim.time(), bearing,
                contacts.size(), mean);
  }
};

int main() {
  // Periodic to the sides, so that every grain but those on the floor is inside the bed.
  const Vector period{0.12, 0.12, 0.0};
  Simulation<> sim{{.period = period, .local_damping = 0.2}};
  const auto rock = sim.add_material({.normal_stiffness = 5e4, .shear_stiffness = 5e4, .restitution = 0.3});
  sim.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  const Clump ball = make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 0.01}});
  Random random{1};
  sim.add(loose_lattice({ball}, std::vector<DrawnClump>(300, {0, 1.0}),
                        {Vector::Zero(), period + Vector::UnitZ()}, random));

  CoordinationNumber coordination;
  run_for(sim, 1.2, Every{0.2, std::ref(coordination)});
  // At rest it lies between the isostatic limits of spheres with and without friction.
  return coordination.mean >= 4.0 && coordination.mean <= 6.0 ? 0 : 1;
}
