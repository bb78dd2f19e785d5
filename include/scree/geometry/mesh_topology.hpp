#pragma once
/// \file
/// Finds what is wrong with a mesh: free, overfull and flipped edges, T-junctions, degenerate facets.

#include "scree/core/error.hpp"
#include "scree/geometry/triangle_mesh.hpp"

#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace scree {

/// The defects of a mesh. Facets and vertices are indices into the mesh, so they count from 0.
struct MeshReport {
  struct Edge {
    std::array<std::uint32_t, 2> vertices; ///< the lower index first
    std::vector<std::size_t> facets;       ///< all facets with this edge, in rising order
  };
  struct TJunction {
    std::uint32_t vertex;
    Edge edge; ///< the edge that the vertex lies in, with its facets
  };

  std::size_t vertex_count = 0;
  std::size_t facet_count = 0;
  std::vector<Edge> free_edges;         ///< edges of one facet
  std::vector<Edge> non_manifold_edges; ///< edges of more than two facets
  std::vector<Edge> flipped_edges;      ///< edges of two facets whose normals disagree
  std::vector<TJunction> t_junctions;
  std::vector<std::size_t> degenerate_facets; ///< a vertex twice, or no height

  /// Whether the mesh bounds a volume: every edge has two facets, and their normals agree.
  [[nodiscard]] bool closed() const {
    return facet_count > 0 && free_edges.empty() && non_manifold_edges.empty() && flipped_edges.empty();
  }
  /// Whether the mesh is closed() and without T-junctions and degenerate facets.
  [[nodiscard]] bool clean() const { return closed() && t_junctions.empty() && degenerate_facets.empty(); }

  /// One line for each kind of defect, with the first few facets concerned. For people, so facets count from
  /// 1 here, as they do in the messages of the STL reader.
  [[nodiscard]] std::string summary() const;
};

namespace detail {

/// One side of a facet, with its ends in rising order.
struct HalfEdge {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t facet;
  bool rising; ///< whether the facet runs from `low` to `high`
};

/// All sides of all facets, those of one edge next to each other. Facets with a vertex twice are left out:
/// their neighbours meet across them.
inline std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> sides;
  sides.reserve(3 * mesh.facets.size());
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const auto& f = mesh.facets[i];
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) {
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto from = f[k];
      const auto to = f[(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(i), from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
  });
  return sides;
}

/// Finds the vertices that lie inside an edge, by an R-tree of the vertices.
class VerticesOnEdge {
public:
  VerticesOnEdge(const TriangleMesh& mesh, double tolerance) : mesh_{mesh}, tolerance_{tolerance} {
    std::vector<bool> used(mesh.vertices.size(), false);
    for (const auto& f : mesh.facets) {
      used[f[0]] = used[f[1]] = used[f[2]] = true;
    }
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (used[i]) {
        const Vector margin = Vector::Constant(tolerance);
        const auto& v = mesh.vertices[i];
        entries.push_back({Box{point(v - margin), point(v + margin)}, static_cast<std::uint32_t>(i)});
      }
    }
    tree_ = Tree(entries.begin(), entries.end());
  }

  /// The vertices nearer than the tolerance to the edge, but not to its ends.
  [[nodiscard]] std::vector<std::uint32_t> operator()(std::uint32_t from, std::uint32_t to) const {
    namespace index = boost::geometry::index;
    const auto& a = mesh_.vertices[from];
    const Vector along = mesh_.vertices[to] - a;
    const double length = along.norm();
    std::vector<std::uint32_t> found;
    if (length <= 2.0 * tolerance_) {
      return found;
    }
    const boost::geometry::model::segment<Point> segment{point(a), point(mesh_.vertices[to])};
    for (auto near = tree_.qbegin(index::intersects(segment)); near != tree_.qend(); ++near) {
      const Vector offset = mesh_.vertices[near->second] - a;
      const double position = offset.dot(along) / length;
      const double distance = offset.cross(along).norm() / length;
      if (position > tolerance_ && position < length - tolerance_ && distance <= tolerance_) {
        found.push_back(near->second);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

private:
  using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Point>;
  using Entry = std::pair<Box, std::uint32_t>;
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>>;

  static Point point(const Vector& v) { return {v.x(), v.y(), v.z()}; }

  const TriangleMesh& mesh_;
  double tolerance_;
  Tree tree_;
};

/// Longest side and the height over it.
inline std::pair<double, double> longest_side_and_height(const std::array<Vector, 3>& corners) {
  const Vector u = corners[1] - corners[0];
  const Vector v = corners[2] - corners[1];
  const double longest = std::max({u.norm(), v.norm(), (u + v).norm()});
  return {longest, longest > 0.0 ? u.cross(v).norm() / longest : 0.0};
}

} // namespace detail

/// Looks for every defect that MeshReport lists. Facets must share vertices to be neighbours: weld() first.
/// \param relative_tolerance share of the mesh's diagonal below which a vertex counts as lying in an edge,
/// and a
///        facet's height as zero; the default is above the rounding of a binary STL file.
/// \throws Error for a facet that names a vertex that does not exist, with the facet's number counted from 1.
inline MeshReport check(const TriangleMesh& mesh, double relative_tolerance = 1e-6) {
  MeshReport report;
  report.vertex_count = mesh.vertices.size();
  report.facet_count = mesh.facets.size();
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    for (const auto v : mesh.facets[i]) {
      if (v >= mesh.vertices.size()) {
        throw Error(message("facet ", i + 1, " names vertex ", v, " of ", mesh.vertices.size()));
      }
      box.extend(mesh.vertices[v]);
    }
  }
  if (mesh.facets.empty()) {
    return report;
  }
  const double tolerance = relative_tolerance * box.diagonal().norm();

  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const auto& f = mesh.facets[i];
    const bool repeated = f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
    if (repeated || detail::longest_side_and_height(mesh.corners(i)).second <= tolerance) {
      report.degenerate_facets.push_back(i);
    }
  }

  const detail::VerticesOnEdge vertices_on_edge(mesh, tolerance);
  const auto sides = detail::sorted_half_edges(mesh);
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const detail::HalfEdge& side) {
      return side.low != first->low || side.high != first->high;
    });
    MeshReport::Edge edge{{first->low, first->high}, {}};
    std::transform(first, last, std::back_inserter(edge.facets),
                   [](const detail::HalfEdge& side) { return std::size_t{side.facet}; });
    for (const auto vertex : vertices_on_edge(edge.vertices[0], edge.vertices[1])) {
      report.t_junctions.push_back({vertex, edge});
    }
    if (edge.facets.size() == 1) {
      report.free_edges.push_back(std::move(edge));
    } else if (edge.facets.size() > 2) {
      report.non_manifold_edges.push_back(std::move(edge));
    } else if (first->rising == std::next(first)->rising) {
      report.flipped_edges.push_back(std::move(edge));
    }
    first = last;
  }
  return report;
}

inline std::string MeshReport::summary() const {
  std::string text =
      message(facet_count, " facets, ", vertex_count, " vertices, ", closed() ? "closed" : "open");
  const auto add = [&text](std::size_t count, std::string_view one, std::string_view several,
                           std::vector<std::size_t> facets) {
    if (count == 0) {
      return;
    }
    std::sort(facets.begin(), facets.end());
    facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
    text +=
        message("\n  ", count, " ", count == 1 ? one : several, " at facet", facets.size() == 1 ? " " : "s ");
    constexpr std::size_t shown = 10;
    for (std::size_t i = 0; i < std::min(shown, facets.size()); ++i) {
      text += message(i == 0 ? "" : ", ", facets[i] + 1);
    }
    if (facets.size() > shown) {
      text += message(" and ", facets.size() - shown, " more");
    }
  };
  const auto facets_of = [](const std::vector<Edge>& edges) {
    std::vector<std::size_t> facets;
    for (const auto& edge : edges) {
      facets.insert(facets.end(), edge.facets.begin(), edge.facets.end());
    }
    return facets;
  };
  std::vector<Edge> split_edges;
  for (const auto& junction : t_junctions) {
    split_edges.push_back(junction.edge);
  }
  add(free_edges.size(), "free edge", "free edges", facets_of(free_edges));
  add(non_manifold_edges.size(), "edge of more than two facets", "edges of more than two facets",
      facets_of(non_manifold_edges));
  add(flipped_edges.size(), "edge between flipped neighbours", "edges between flipped neighbours",
      facets_of(flipped_edges));
  add(t_junctions.size(), "T-junction", "T-junctions", facets_of(split_edges));
  add(degenerate_facets.size(), "degenerate facet", "degenerate facets", degenerate_facets);
  return text;
}

/// The parts of a mesh that share no vertex with each other, in the order of their first facets. Vertices
/// that no facet names are dropped.
inline std::vector<TriangleMesh> shells(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&parent](std::uint32_t v) {
    while (parent[v] != v) {
      v = parent[v] = parent[parent[v]];
    }
    return v;
  };
  for (const auto& f : mesh.facets) {
    parent[root(f[1])] = root(f[0]);
    parent[root(f[2])] = root(f[0]);
  }
  constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> shell_of(mesh.vertices.size(), none); // by root
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), none);
  std::vector<TriangleMesh> parts;
  for (const auto& f : mesh.facets) {
    auto& number = shell_of[root(f[0])];
    if (number == none) {
      number = static_cast<std::uint32_t>(parts.size());
      parts.emplace_back();
    }
    auto& part = parts[number];
    TriangleMesh::Facet facet{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (renumbered[f[k]] == none) {
        renumbered[f[k]] = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[f[k]]);
      }
      facet[k] = renumbered[f[k]];
    }
    part.facets.push_back(facet);
  }
  return parts;
}

} // namespace scree
