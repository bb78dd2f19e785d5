#pragma once
/// \file
/// A bed as files: one for scree, one for LAMMPS and LIGGGHTS, with all digits.

#include "../support/periodic_bed.hpp"
#include "scree/core/error.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

namespace scree::benchmarks {

inline std::ofstream opened_for_writing(const std::filesystem::path& path) {
  std::ofstream out{path};
  out.precision(17);
  if (!out) {
    throw Error(message(path.string(), ": cannot be written"));
  }
  return out;
}

inline void close(std::ofstream& out, const std::filesystem::path& path) {
  out.close();
  if (!out) {
    throw Error(message(path.string(), ": not written to its end"));
  }
}

/// Four spheres of 5.5 mm whose centres are 4.5 mm from the middle, at scale 1. The other codes sum up the
/// masses and moments of the spheres, so this does, too.
inline Clump tetrahedron() {
  const double c = 0.0045 / std::sqrt(3.0), r = 0.0055;
  return make_clump("tetrahedron",
                    std::vector<Sphere>{{{c, c, c}, r}, {{c, -c, -c}, r}, {{-c, c, -c}, r}, {{-c, -c, c}, r}},
                    MassConvention::sum_of_spheres);
}

/// \throws Error for a name that is not known.
inline Clump shape_named(const std::string& name) {
  if (name == "ball") {
    return unit_ball();
  }
  if (name == "tetrahedron") {
    return tetrahedron();
  }
  throw Error(message("no shape is named '", name, "'; there are ball and tetrahedron"));
}

/// First line: count, period [m] and shape; then for each body a line `x y z scale`, quaternion `w x y z`,
/// velocity, angular velocity [m, m/s, rad/s].
inline void write_bed(const std::filesystem::path& path, const PeriodicBed& bed) {
  std::ofstream out = opened_for_writing(path);
  out << bed.packing.bodies.size() << ' ' << bed.period.x() << ' ' << bed.period.y() << ' '
      << bed.packing.shapes.front().name << '\n';
  const auto put = [&](const Vector& v) { out << ' ' << v.x() << ' ' << v.y() << ' ' << v.z(); };
  for (const PackedBody& b : bed.packing.bodies) {
    put(b.position);
    out << ' ' << b.scale << ' ' << b.orientation.w();
    put(b.orientation.vec());
    put(b.velocity);
    put(b.angular_velocity);
    out << '\n';
  }
  close(out, path);
}

/// \throws Error for a file that does not hold what its first line says.
inline PeriodicBed read_bed(const std::filesystem::path& path) {
  std::ifstream in{path};
  PeriodicBed bed;
  std::size_t count = 0;
  std::string shape;
  in >> count >> bed.period.x() >> bed.period.y() >> shape;
  if (in) {
    bed.packing.shapes = {shape_named(shape)};
  }
  const auto get = [&](Vector& v) { in >> v.x() >> v.y() >> v.z(); };
  for (std::size_t k = 0; in && k < count; ++k) {
    PackedBody b;
    Vector turn;
    get(b.position);
    in >> b.scale >> b.orientation.w();
    get(turn);
    b.orientation.vec() = turn;
    get(b.velocity);
    get(b.angular_velocity);
    bed.packing.bodies.push_back(b);
  }
  if (!in || count == 0) {
    throw Error(message(path.string(), ": not a bed of ", count, " bodies"));
  }
  return bed;
}

/// What read_data of LAMMPS and LIGGGHTS reads; the spheres of all bodies are numbered through from 1.
/// Clumps come with image flags, which keep their spheres together across the period, and as molecules.
inline void write_peers_data(const std::filesystem::path& path, const PeriodicBed& bed) {
  struct Atom {
    std::size_t body;
    double radius;
    Vector position, velocity, spin;
  };
  std::vector<Atom> atoms;
  double top = 0.0;
  for (std::size_t b = 0; b < bed.packing.bodies.size(); ++b) {
    const PackedBody& body = bed.packing.bodies[b];
    for (const Sphere& sphere : spheres_in_space(bed.packing, body)) {
      const Vector arm = sphere.centre - body.position;
      atoms.push_back({b, sphere.radius, sphere.centre, body.velocity + body.angular_velocity.cross(arm),
                       body.angular_velocity});
      top = std::max(top, sphere.centre.z());
    }
  }
  const bool clumps = atoms.size() > bed.packing.bodies.size();
  std::ofstream out = opened_for_writing(path);
  out << "a bed of frictional grains\n\n"
      << atoms.size() << " atoms\n2 atom types\n\n"
      << "0 " << bed.period.x() << " xlo xhi\n0 " << bed.period.y() << " ylo yhi\n-0.02 " << top + 0.1
      << " zlo zhi\n\nAtoms # sphere\n\n";
  for (std::size_t k = 0; k < atoms.size(); ++k) {
    const Atom& atom = atoms[k];
    const double nx = std::floor(atom.position.x() / bed.period.x());
    const double ny = std::floor(atom.position.y() / bed.period.y());
    out << k + 1 << " 1 " << 2.0 * atom.radius << ' ' << bed_material().density << ' '
        << atom.position.x() - nx * bed.period.x() << ' ' << atom.position.y() - ny * bed.period.y() << ' '
        << atom.position.z() << ' ' << static_cast<int>(nx) << ' ' << static_cast<int>(ny) << " 0\n";
  }
  out << "\nVelocities\n\n";
  const auto put = [&](const Vector& v) { out << ' ' << v.x() << ' ' << v.y() << ' ' << v.z(); };
  for (std::size_t k = 0; k < atoms.size(); ++k) {
    out << k + 1;
    put(atoms[k].velocity);
    put(atoms[k].spin);
    out << '\n';
  }
  if (clumps) {
    out << "\nMolecules\n\n";
    for (std::size_t k = 0; k < atoms.size(); ++k) {
      out << k + 1 << ' ' << atoms[k].body + 1 << '\n';
    }
  }
  close(out, path);
}

} // namespace scree::benchmarks
