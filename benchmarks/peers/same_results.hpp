#pragma once
/// \file
/// Whether two codes compute the same: the forces of the first step, and where some steps lead.

#include "bed_file.hpp"
#include "timed_steps.hpp"

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

/// One vector for each sphere: those of body 0, of body 1, ...
using Vectors = std::vector<Vector>;

/// value(sphere) for all spheres of a simulation whose bodies have `members` spheres each, in the order of
/// the bodies' ids.
template <class Model, class Value>
Vectors by_sphere(const Simulation<Model>& simulation, std::size_t members, Value value) {
  const auto& bodies = simulation.bodies();
  Vectors out(bodies.sphere_count());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (std::size_t k = 0; k < members; ++k) {
      out.at(bodies.id(b) * members + k) = value(bodies.first_sphere(b) + k);
    }
  }
  return out;
}

inline std::size_t members_of(const PeriodicBed& bed) {
  return bed.packing.shapes.front().spheres.size();
}

/// N, of contacts and floor on every sphere in the first step, by scree. The step is so short that the
/// springs' growth in it, which LAMMPS leaves out at the start of a run, is below rounding, and no contact
/// may slide: one that slides without a spring has no friction there in LAMMPS.
template <class Model>
Vectors first_forces(const PeriodicBed& bed) {
  TimedScene<Model> scene{bed, {}, 1e-16};
  Simulation<Model>& simulation = scene.simulation;
  Material never_sliding = bed_material();
  never_sliding.friction = 1e4;
  simulation.change_material(0, never_sliding);
  simulation.step();
  return by_sphere(simulation, members_of(bed),
                   [&](std::size_t s) { return to_eigen(simulation.bodies().forces()[s].force); });
}

/// m, where some steps lead each sphere, by scree; less whole periods.
inline Vectors displacements(const PeriodicBed& bed, int steps) {
  TimedScene<TimedModel<double, false>> scene{bed, {}};
  const auto& simulation = scene.simulation;
  const auto places = [&] {
    return by_sphere(simulation, members_of(bed),
                     [&](std::size_t s) { return to_eigen(simulation.bodies().spheres()[s].position); });
  };
  const Vectors before = places();
  scene.advance(steps);
  Vectors moved = places();
  for (std::size_t k = 0; k < moved.size(); ++k) {
    moved[k] -= before[k];
    for (const int d : {0, 1}) {
      moved[k][d] -= bed.period[d] * std::round(moved[k][d] / bed.period[d]);
    }
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

/// The spheres of a bed, in the order of their bodies.
inline std::vector<Sphere> spheres_of(const PeriodicBed& bed) {
  std::vector<Sphere> out;
  for (const PackedBody& body : bed.packing.bodies) {
    const auto own = spheres_in_space(bed.packing, body);
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

/// first_forces() by LAMMPS, from its dump of `fx fy fz`, which has gravity in it.
inline Vectors lammps_forces(const std::filesystem::path& dump, const PeriodicBed& bed) {
  const std::vector<Sphere> spheres = spheres_of(bed);
  Vectors forces = read_dump(dump, spheres.size());
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const double mass = bed_material().density * unit_ball().volume * std::pow(spheres[k].radius, 3);
    forces[k].z() += 9.81 * mass;
  }
  return forces;
}

/// displacements() by LAMMPS, from its dump of `xu yu zu`.
inline Vectors lammps_displacements(const std::filesystem::path& dump, const PeriodicBed& bed) {
  const std::vector<Sphere> spheres = spheres_of(bed);
  Vectors moved = read_dump(dump, spheres.size());
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    moved[k] -= spheres[k].centre;
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
