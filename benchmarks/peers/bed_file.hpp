#pragma once
/// \file
/// The bed as files: one for scree, one for LAMMPS, with all digits.

#include "../support/periodic_bed.hpp"
#include "scree/core/error.hpp"

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

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

/// First line: count and period [m]; then a line `x y z radius velocity` [m, m/s] for each sphere.
inline void write_bed(const std::filesystem::path& path, const PeriodicBed& bed) {
  std::ofstream out = opened_for_writing(path);
  out << bed.packing.bodies.size() << ' ' << bed.period.x() << ' ' << bed.period.y() << '\n';
  for (const PackedBody& b : bed.packing.bodies) {
    out << b.position.x() << ' ' << b.position.y() << ' ' << b.position.z() << ' ' << b.scale << ' '
        << b.velocity.x() << ' ' << b.velocity.y() << ' ' << b.velocity.z() << '\n';
  }
  close(out, path);
}

/// \throws Error for a file that does not hold what its first line says.
inline PeriodicBed read_bed(const std::filesystem::path& path) {
  std::ifstream in{path};
  PeriodicBed bed{{{unit_ball()}, {}}, Vector::Zero()};
  std::size_t count = 0;
  in >> count >> bed.period.x() >> bed.period.y();
  for (std::size_t k = 0; in && k < count; ++k) {
    PackedBody b;
    in >> b.position.x() >> b.position.y() >> b.position.z() >> b.scale;
    in >> b.velocity.x() >> b.velocity.y() >> b.velocity.z();
    bed.packing.bodies.push_back(b);
  }
  if (!in || count == 0) {
    throw Error(message(path.string(), ": not a bed of ", count, " spheres"));
  }
  return bed;
}

/// What LAMMPS's read_data reads under atom_style sphere; atom k + 1 is body k.
inline void write_lammps_data(const std::filesystem::path& path, const PeriodicBed& bed) {
  std::ofstream out = opened_for_writing(path);
  double top = 0.0;
  for (const PackedBody& b : bed.packing.bodies) {
    top = std::max(top, b.position.z());
  }
  out << "a settled bed of frictional spheres\n\n"
      << bed.packing.bodies.size() << " atoms\n1 atom types\n\n"
      << "0 " << bed.period.x() << " xlo xhi\n0 " << bed.period.y() << " ylo yhi\n-0.02 " << top + 0.1
      << " zlo zhi\n\nAtoms # sphere\n\n";
  std::size_t id = 0;
  for (const PackedBody& b : bed.packing.bodies) {
    out << ++id << " 1 " << 2.0 * b.scale << ' ' << bed_material().density << ' ' << b.position.x() << ' '
        << b.position.y() << ' ' << b.position.z() << '\n';
  }
  out << "\nVelocities\n\n";
  id = 0;
  for (const PackedBody& b : bed.packing.bodies) {
    out << ++id << ' ' << b.velocity.x() << ' ' << b.velocity.y() << ' ' << b.velocity.z() << " 0 0 0\n";
  }
  close(out, path);
}

} // namespace scree::benchmarks
