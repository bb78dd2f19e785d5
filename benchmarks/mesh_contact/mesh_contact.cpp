// What does it cost to find where a sphere touches a bucket?

#include "scree/core/random.hpp"
#include "scree/geometry/dragline_bucket.hpp"
#include "scree/geometry/mesh_surface.hpp"

#include <benchmark/benchmark.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace {

using namespace scree;

constexpr double radius = 0.005;       // m
constexpr double margin = 0.3 * 0.005; // m, of VerletList for such spheres
constexpr std::size_t sphere_count = 512;

const MeshSurface& bucket(BucketDetail detail) {
  static const MeshSurface simplified{make_dragline_bucket({}, BucketDetail::simplified)};
  static const MeshSurface detailed{make_dragline_bucket({}, BucketDetail::detailed)};
  return detail == BucketDetail::simplified ? simplified : detailed;
}

/// How many corners of a facet the nearest point of the surface is on: 3 for a face, 2 an edge, 1 a vertex.
int nearest_feature(const MeshSurface& surface, const Vector& centre,
                    const std::vector<std::uint32_t>& facets) {
  double least = std::numeric_limits<double>::infinity();
  int corners = 0;
  for (const std::uint32_t f : facets) {
    const ClosestPoint nearest = closest_point(surface.mesh().corners(f), centre);
    if (const double d2 = (nearest.point - centre).squaredNorm(); d2 < least) {
      least = d2;
      corners = std::popcount(nearest.feature);
    }
  }
  return corners;
}

/// A place about nine tenths of a radius away from a random vertex or point of a facet.
Vector random_centre(const MeshSurface& surface, Random& random) {
  const auto& mesh = surface.mesh();
  const auto facet = static_cast<std::size_t>(random.uniform() * static_cast<double>(mesh.facets.size()));
  const auto t = mesh.corners(facet);
  double u = random.uniform(), v = random.uniform();
  if (u + v > 1.0) {
    u = v = 0.0;
  }
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) +
         0.9 * radius * (random.orientation() * Vector::UnitX());
}

struct Touching {
  std::vector<Vector> centres;
  std::vector<std::vector<std::uint32_t>> facets; ///< as the candidate search lists them
};

/// Spheres whose nearest point is on a face (3), an edge (2) or a vertex (1).
Touching made_touching(const MeshSurface& surface, int corners) {
  Random random{5};
  Touching out;
  while (out.centres.size() < sphere_count) {
    const Vector centre = random_centre(surface, random);
    std::vector<std::uint32_t> facets;
    surface.facets_near(centre, radius + margin, facets);
    if (nearest_feature(surface, centre, facets) == corners) {
      out.centres.push_back(centre);
      out.facets.push_back(std::move(facets));
    }
  }
  return out;
}

void count_spheres(benchmark::State& state) {
  state.counters["sphere"] =
      benchmark::Counter(static_cast<double>(sphere_count),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Done in every step for every sphere near the mesh.
template <int corners>
void touch(benchmark::State& state) {
  const MeshSurface& surface = bucket(static_cast<BucketDetail>(state.range(0)));
  const Touching spheres = made_touching(surface, corners);
  SurfaceContacts contacts;
  std::size_t found = 0;
  for (auto _ : state) {
    found = 0;
    for (std::size_t s = 0; s < sphere_count; ++s) {
      contacts.clear();
      surface.touch(spheres.facets[s], spheres.centres[s], radius, contacts);
      found += contacts.size();
    }
    benchmark::DoNotOptimize(found);
  }
  if (found < sphere_count) {
    state.SkipWithError("a sphere that overlaps the mesh has no contact");
  }
  std::size_t facets = 0;
  for (const auto& listed : spheres.facets) {
    facets += listed.size();
  }
  count_spheres(state);
  state.counters["contacts"] = static_cast<double>(found) / sphere_count;
  state.counters["listed_facets"] = static_cast<double>(facets) / sphere_count;
}

/// Done at each renewal of the lists for every sphere near the mesh.
void find_candidates(benchmark::State& state) {
  const MeshSurface& surface = bucket(static_cast<BucketDetail>(state.range(0)));
  const Touching spheres = made_touching(surface, 3);
  std::vector<std::uint32_t> facets;
  for (auto _ : state) {
    for (const Vector& centre : spheres.centres) {
      facets.clear();
      surface.facets_near(centre, radius + margin, facets);
      benchmark::DoNotOptimize(facets.data());
    }
  }
  count_spheres(state);
}

void meshes(benchmark::internal::Benchmark* b) {
  b->ArgName("detail");
  for (const BucketDetail detail : {BucketDetail::simplified, BucketDetail::detailed}) {
    b->Arg(static_cast<std::int64_t>(detail));
  }
}

} // namespace

BENCHMARK_TEMPLATE(touch, 3)->Name("touch_face")->Apply(meshes);
BENCHMARK_TEMPLATE(touch, 2)->Name("touch_edge")->Apply(meshes);
BENCHMARK_TEMPLATE(touch, 1)->Name("touch_vertex")->Apply(meshes);
BENCHMARK(find_candidates)->Apply(meshes);
