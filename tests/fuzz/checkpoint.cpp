#include "fuzz/attempt.hpp"
#include "fuzz/readers.hpp"

#include "scree/core/archive.hpp"
#include "scree/io/checkpoint_file.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree::test {

void read_as_checkpoint(std::string_view bytes) {
  const auto file = file_with("state.checkpoint", bytes);
  attempt(file.string(), [&] { (void)read_one_checkpoint(file, "a simulation"); });
  attempt("the bytes", [&] {
    Simulation<> simulation;
    const auto rock = simulation.add_material({.normal_stiffness = 1e4, .shear_stiffness = 1e4});
    simulation.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
    ArchiveReader reader{bytes, "the bytes"};
    reader(simulation);
    reader.end();
    const auto& bodies = simulation.bodies();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      insist(bodies.first_sphere(b) < bodies.first_sphere(b + 1), "a body has no sphere");
      insist(bodies.first_sphere(b + 1) <= bodies.sphere_count(), "a body has spheres that are not there");
    }
    simulation.visit_contacts([](const ContactView&) {});
  });
}

} // namespace scree::test
