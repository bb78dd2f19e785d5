#pragma once
/// \file
/// Whether two codes compute the same: the forces of the first step, and where some steps lead.

#include "bed_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace scree::benchmarks {

/// The bed squeezed in z at `rate` [1/s], so that the dashpots come into play in the very first step. All
/// contacts close: where a dashpot pulls, LAMMPS takes the friction limit from the size of the normal force,
/// scree takes none.
inline PeriodicBed squeezed(PeriodicBed bed, double rate) {
  for (PackedBody& b : bed.packing.bodies) {
    b.velocity.z() = -rate * b.position.z();
  }
  return bed;
}

/// One vector for each body, by its id.
using Vectors = std::vector<Vector>;

/// N, of contacts and floor on every sphere in the first step, by scree. The step is so short that the
/// springs' growth in it, which LAMMPS leaves out at the start of a run, is below rounding, and no contact
/// may slide: one that slides without a spring has no friction there in LAMMPS.
inline Vectors first_forces(const PeriodicBed& bed) {
  Simulation<> simulation{bed_setup<DefaultModel>(bed, 1, 1e-16)};
  fill(simulation, bed);
  Material never_sliding = bed_material();
  never_sliding.friction = 1e4;
  simulation.change_material(0, never_sliding);
  simulation.step();
  const auto& bodies = simulation.bodies();
  Vectors forces(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    forces.at(bodies.id(b)) = to_eigen(bodies.forces()[bodies.first_sphere(b)].force);
  }
  return forces;
}

/// m, by which each sphere moves in some steps from rest, by scree.
inline Vectors displacements(const PeriodicBed& bed, int steps) {
  Simulation<> simulation{bed_setup<DefaultModel>(bed, 1)};
  fill(simulation, bed);
  for (int k = 0; k < steps; ++k) {
    simulation.step();
  }
  const auto& bodies = simulation.bodies();
  Vectors moved(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Vector by = bodies.position(b) - bed.packing.bodies.at(bodies.id(b)).position;
    for (const int d : {0, 1}) {
      by[d] -= bed.period[d] * std::round(by[d] / bed.period[d]);
    }
    moved.at(bodies.id(b)) = by;
  }
  return moved;
}

/// Reads a dump of LAMMPS whose columns are the id and three numbers.
/// \throws Error where a line is missing or is not of that form.
inline Vectors read_dump(const std::filesystem::path& path, std::size_t atoms) {
  std::ifstream in{path};
  std::string line;
  while (std::getline(in, line) && line.rfind("ITEM: ATOMS id ", 0) != 0) {
  }
  Vectors values(atoms, Vector::Constant(std::numeric_limits<double>::quiet_NaN()));
  for (std::size_t id = 0; in >> id;) {
    Vector v;
    if (!(in >> v.x() >> v.y() >> v.z()) || id == 0 || id > atoms) {
      throw Error(message(path.string(), ": the line of atom ", id, " is not an id and three numbers"));
    }
    values[id - 1] = v;
  }
  for (std::size_t k = 0; k < atoms; ++k) {
    if (!values[k].allFinite()) {
      throw Error(message(path.string(), ": atom ", k + 1, " is missing"));
    }
  }
  return values;
}

/// first_forces() by LAMMPS, from its dump of `fx fy fz`, which has gravity in it.
inline Vectors lammps_forces(const std::filesystem::path& dump, const PeriodicBed& bed) {
  const auto& bodies = bed.packing.bodies;
  Vectors forces = read_dump(dump, bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const double mass = bed_material().density * unit_ball().volume * std::pow(bodies[k].scale, 3);
    forces[k].z() += 9.81 * mass;
  }
  return forces;
}

/// displacements() by LAMMPS, from its dump of `xu yu zu`.
inline Vectors lammps_displacements(const std::filesystem::path& dump, const PeriodicBed& bed) {
  const auto& bodies = bed.packing.bodies;
  Vectors moved = read_dump(dump, bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    moved[k] -= bodies[k].position;
  }
  return moved;
}

inline double root_mean_square(const Vectors& a) {
  double squares = 0.0;
  for (const Vector& v : a) {
    squares += v.squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(a.size()));
}

inline Vectors difference(const Vectors& a, const Vectors& b) {
  Vectors out(a.size());
  std::transform(a.begin(), a.end(), b.begin(), out.begin(),
                 [](const Vector& p, const Vector& q) { return p - q; });
  return out;
}

inline double largest(const Vectors& a) {
  double most = 0.0;
  for (const Vector& v : a) {
    most = std::max(most, v.norm());
  }
  return most;
}

} // namespace scree::benchmarks
