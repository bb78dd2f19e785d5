#pragma once
/// \file
/// The bed that whole steps are timed on: grains at rest on a floor, periodic in x and y.

#include "scree/core/random.hpp"
#include "scree/packing/packing.hpp"
#include "scree/simulation/run.hpp"
#include "scree/simulation/simulation.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace scree::benchmarks {

/// Grains at rest; they stand on the plane z = 0 and repeat with the period in x and y.
struct PeriodicBed {
  Packing packing;
  Vector period = Vector::Zero(); ///< m
};

/// Soft rock: k_n = k_t = 1e5 N/m at the contact, dashpots in proportion to the mass of the pair that give a
/// restitution of about 0.5 to grains of 7 mm.
inline Material bed_material() {
  return {.density = 1518.0,
          .normal_stiffness = 1e5,
          .shear_stiffness = 1e5,
          .friction = 0.53,
          .normal_damping_rate = 3700.0,
          .shear_damping_rate = 1850.0};
}

template <class Model>
Setup<Model> bed_setup(const PeriodicBed& bed, unsigned threads, double time_step = 1e-5) {
  Setup<Model> setup;
  setup.stiffness = Stiffness::of_contact;
  setup.period = bed.period;
  setup.time_step = time_step;
  setup.threads = threads;
  return setup;
}

/// Puts the bed and its floor into an empty simulation.
template <class Model>
void fill(Simulation<Model>& simulation, const PeriodicBed& bed, const Material& material = bed_material()) {
  const MaterialId rock = simulation.add_material(material);
  simulation.add_wall({.name = "floor", .surfaces = {{Plane{}, rock}}, .dynamics = Fixed{}});
  simulation.add(bed.packing);
}

/// Puts the bodies of a bed where a simulation that was filled with it has them, within the period.
template <class Model>
void place_as_in(const Simulation<Model>& simulation, PeriodicBed& bed) {
  const auto& bodies = simulation.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    PackedBody& body = bed.packing.bodies.at(bodies.id(b));
    body.position = bodies.position(b);
    body.orientation = bodies.orientation(b);
    for (const int d : {0, 1}) {
      body.position[d] -= bed.period[d] * std::floor(body.position[d] / bed.period[d]);
    }
  }
}

/// The size of the grains of a bed: their scale is drawn uniformly.
struct Sizes {
  double least, most;
};

/// A ball of 1 m, for beds of spheres: the scale is the radius.
inline Clump unit_ball() {
  return make_clump("ball", std::vector<Sphere>{{Vector::Zero(), 1.0}}, MassConvention::union_of_spheres);
}

/// Lets `count` grains of one shape fall from a jittered lattice into a cell of `side` by `side` [m] and
/// waits until they rest. The same seed gives the same bed.
inline PeriodicBed settled_bed(const Clump& shape, const Sizes& sizes, std::size_t count, double side,
                               unsigned threads, std::uint64_t seed = 12345) {
  PeriodicBed bed{{{shape}, {}}, {side, side, 0.0}};
  Random random{seed};
  const auto across = static_cast<std::size_t>(side / (2.06 * sizes.most * shape.bounding_radius));
  const double pitch = side / static_cast<double>(across);
  for (std::size_t k = 0; k < count; ++k) {
    PackedBody body;
    body.scale = random.uniform(sizes.least, sizes.most);
    const double room = 0.9 * (0.5 * pitch - body.scale * shape.bounding_radius);
    const auto place = [&](std::size_t cell) {
      return (static_cast<double>(cell) + 0.5) * pitch + random.uniform(-room, room);
    };
    const double x = place(k % across), y = place(k / across % across), z = place(k / across / across);
    body.position = {x, y, z};
    body.orientation = random.orientation();
    bed.packing.bodies.push_back(body);
  }

  Simulation<> simulation{bed_setup<DefaultModel>(bed, threads, 0.0)};
  fill(simulation, bed);
  run_for(simulation, 0.6);
  simulation.set_local_damping(0.5); // for rest, not for realism
  run_for(simulation, 0.3);
  place_as_in(simulation, bed);
  return bed;
}

/// The bed repeated nx times in x and ny times in y.
inline PeriodicBed tiled(const PeriodicBed& bed, std::size_t nx, std::size_t ny) {
  PeriodicBed out{{bed.packing.shapes, {}}, Vector::Zero()};
  const auto columns = static_cast<double>(nx), rows = static_cast<double>(ny);
  out.period = bed.period.cwiseProduct(Vector{columns, rows, 0.0});
  for (std::size_t y = 0; y < ny; ++y) {
    for (std::size_t x = 0; x < nx; ++x) {
      const Vector shift =
          bed.period.cwiseProduct(Vector{static_cast<double>(x), static_cast<double>(y), 0.0});
      for (PackedBody body : bed.packing.bodies) {
        body.position += shift;
        out.packing.bodies.push_back(std::move(body));
      }
    }
  }
  return out;
}

} // namespace scree::benchmarks
