#pragma once
/// \file
/// The facets of an STL file, whatever its form: gathered into a mesh when read, checked when written.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/geometry/mesh_weld.hpp"
#include "scree/geometry/triangle_mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace scree {

/// How an STL file is read.
struct StlOptions {
  double scale = 1.0;                 ///< m per unit of the file, above 0; STL files hold no unit
  double weld_tolerance = 0.0;        ///< m, see weld(); 0 welds equal coordinates
  std::size_t max_facets = 5'000'000; ///< a file with more is refused before it fills the memory
};

namespace detail {

/// Adds a corner read from a file, and with every third one a facet.
class StlSoup {
public:
  explicit StlSoup(const StlOptions& options) : options_{options} {}

  /// Whether the corner is finite; one that is not is left out.
  [[nodiscard]] bool add(const Vector& corner) {
    const Vector scaled = options_.scale * corner;
    if (!scaled.allFinite()) {
      return false;
    }
    soup_.vertices.push_back(scaled);
    if (soup_.vertices.size() % 3 == 0) {
      const auto next = static_cast<std::uint32_t>(soup_.vertices.size());
      soup_.facets.push_back({next - 3, next - 2, next - 1});
    }
    return true;
  }
  [[nodiscard]] std::size_t facet_count() const { return soup_.facets.size(); }
  [[nodiscard]] TriangleMesh welded() const { return weld(soup_, options_.weld_tolerance); }

private:
  const StlOptions& options_;
  TriangleMesh soup_;
};

/// Throws for a mesh that no STL file can hold.
inline void require_writable_stl(const TriangleMesh& mesh, const std::filesystem::path& file,
                                 double largest) {
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    for (const auto v : mesh.facets[i]) {
      if (v >= mesh.vertices.size()) {
        throw file_error(file, i + 1,
                         message("facet ", i + 1, " names vertex ", v, " of ", mesh.vertices.size()));
      }
      if (!(mesh.vertices[v].cwiseAbs().maxCoeff() <= largest) || !mesh.vertices[v].allFinite()) {
        throw file_error(file, i + 1,
                         message("facet ", i + 1, " has a coordinate that the file cannot hold"));
      }
    }
  }
}

/// Unit normal by the right hand rule; zero for a facet without area.
inline Vector stl_normal(const std::array<Vector, 3>& corners) {
  const Vector n = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
  return n.allFinite() ? n : Vector{0.0, 0.0, 0.0};
}

} // namespace detail

} // namespace scree
