// How long does a whole time step take, per sphere and per contact?

#include "../support/periodic_bed.hpp"
#include "scree/contact/adhesion.hpp"
#include "scree/contact/attrition.hpp"
#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/linear_spring.hpp"
#include "scree/contact/normal_exponent.hpp"
#include "scree/contact/normal_hysteresis.hpp"
#include "scree/contact/rate_friction.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/geometry/dragline_bucket.hpp"
#include "scree/packing/templates.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace {

using namespace scree;
using namespace scree::benchmarks;

template <class Number, bool audit, class Law = DefaultModel::Contact>
struct BedModel : DefaultModel {
  using Real = Number;
  using Contact = Law;
  using Walls = scree::Walls<Fixed, Prescribed>;
  static constexpr bool energy_audit = audit;
};

// A cell of the bed, settled once; it is tiled to the wanted size. Both are 0.24 m deep or so.
const PeriodicBed& cell_of_spheres() {
  static const PeriodicBed cell = settled_bed(unit_ball(), {0.005, 0.0095}, 1250, 0.125, 1);
  return cell;
}
const PeriodicBed& cell_of_clumps() {
  static const PeriodicBed cell =
      settled_bed(make_clump("pyramid", pyramid_of_spheres()), {0.008, 0.014}, 625, 0.125, 1);
  return cell;
}

PeriodicBed bed_of(const PeriodicBed& cell, std::int64_t tiles) {
  const auto n = static_cast<std::size_t>(tiles);
  return tiled(cell, n, n);
}

/// Removes the grains in the way of a bucket set into the middle of the bed.
void make_room(PeriodicBed& bed, const TriangleMesh& mesh, const Vector& at) {
  const MeshSurface surface{mesh};
  const auto touches = [&](const PackedBody& body) {
    SurfaceContacts contacts;
    std::vector<std::uint32_t> facets;
    for (const Sphere& sphere : spheres_in_space(bed.packing, body)) {
      surface.facets_near(sphere.centre - at, sphere.radius, facets);
    }
    return !facets.empty();
  };
  auto& bodies = bed.packing.bodies;
  bodies.erase(std::remove_if(bodies.begin(), bodies.end(), touches), bodies.end());
}

constexpr int warm_steps = 100;

template <class Model>
void time_steps(benchmark::State& state, Simulation<Model>& simulation) {
  for (int k = 0; k < warm_steps; ++k) {
    simulation.step();
  }
  for (auto _ : state) {
    simulation.step();
  }
  std::size_t contacts = 0;
  simulation.visit_contacts([&contacts](const ContactView&) { ++contacts; });
  const auto each = [](std::size_t count) {
    return benchmark::Counter(static_cast<double>(count),
                              benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  };
  state.counters["spheres"] = static_cast<double>(simulation.bodies().sphere_count());
  state.counters["sphere"] = each(simulation.bodies().sphere_count());
  state.counters["body"] = each(simulation.bodies().size());
  state.counters["contact"] = each(contacts);
}

template <class Real, bool audit>
void spheres(benchmark::State& state) {
  using Model = BedModel<Real, audit>;
  const PeriodicBed bed = bed_of(cell_of_spheres(), state.range(0));
  Simulation<Model> simulation{bed_setup<Model>(bed, static_cast<unsigned>(state.range(1)))};
  fill(simulation, bed);
  time_steps(state, simulation);
}

/// Gives an extension a parameter that is not null, weak enough that the bed stays as it is.
void set_working(RollingResistance&) {}
void set_working(Adhesion& of) {
  of.work = 1e-4;
}
void set_working(Attrition& of) {
  of.rate = 1e-3;
}
void set_working(NormalExponent& of) {
  of.exponent = 1.1;
}
void set_working(NormalHysteresis& of) {
  of.ratio = 1.2;
}
void set_working(RateFriction& of) {
  of.slope = 0.1;
}

template <class Base>
Base working(const std::type_identity<Base>&) {
  return {};
}
template <class... Extensions>
LinearSpring<Extensions...> working(const std::type_identity<LinearSpring<Extensions...>>&) {
  return LinearSpring<Extensions...>{[](auto extension) {
    set_working(extension);
    return extension;
  }(Extensions{})...};
}

/// The bed with another law. The modulus makes a contact of the laws of Hertz about as stiff, under the mean
/// force in the bed, as one of the linear laws.
template <class Law>
void spheres_by_law(benchmark::State& state) {
  using Model = BedModel<double, true, Law>;
  constexpr double stable = 0.0; // s: the step that is stable with this law
  const PeriodicBed bed = bed_of(cell_of_spheres(), state.range(0));
  auto setup = bed_setup<Model>(bed, static_cast<unsigned>(state.range(1)), stable);
  setup.contact = working(std::type_identity<Law>{});
  Simulation<Model> simulation{setup};
  Material material = bed_material();
  material.youngs_modulus = 1.7e9;
  material.rolling_friction = 0.1;
  fill(simulation, bed, material);
  time_steps(state, simulation);
}

void clumps(benchmark::State& state) {
  using Model = BedModel<double, true>;
  const PeriodicBed bed = bed_of(cell_of_clumps(), state.range(0));
  Simulation<Model> simulation{bed_setup<Model>(bed, static_cast<unsigned>(state.range(1)))};
  fill(simulation, bed);
  time_steps(state, simulation);
}

/// A bucket of about 520 facets that moves at 0.2 m/s through the bed of spheres, so that lists are renewed
/// too.
void spheres_and_bucket(benchmark::State& state) {
  using Model = BedModel<double, true>;
  PeriodicBed bed = bed_of(cell_of_spheres(), state.range(0));
  const TriangleMesh mesh = make_dragline_bucket({}, BucketDetail::simplified);
  const Vector at{0.1, 0.5 * bed.period.y(), 0.05};
  make_room(bed, mesh, at);
  Simulation<Model> simulation{bed_setup<Model>(bed, static_cast<unsigned>(state.range(1)))};
  fill(simulation, bed);
  simulation.add_wall(
      {.name = "bucket",
       .surfaces = {{mesh, 0}},
       .dynamics = Prescribed::constant_velocity({0.2, 0.0, 0.0}, {at, Quaternion::Identity()})});
  time_steps(state, simulation);
}

void beds(benchmark::internal::Benchmark* b) {
  b->ArgNames({"tiles", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (const std::int64_t tiles : {2, 4, 8}) {
    for (const std::int64_t threads : {1, 2}) {
      b->Args({tiles, threads});
    }
  }
}
void middling_bed(benchmark::internal::Benchmark* b) {
  b->ArgNames({"tiles", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond)->Args({4, 1})->Args({4, 2});
}

} // namespace

BENCHMARK_TEMPLATE(spheres, double, true)->Apply(beds);
BENCHMARK_TEMPLATE(spheres, double, false)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres, float, true)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres, float, false)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres_by_law, LinearSpring<>)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres_by_law, LinearSpring<RollingResistance>)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres_by_law, LinearSpring<Adhesion>)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres_by_law, LinearSpring<NormalExponent>)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres_by_law, LinearSpring<NormalHysteresis>)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres_by_law, LinearSpring<RateFriction>)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres_by_law, LinearSpring<Attrition>)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres_by_law, HertzMindlin<>)->Apply(middling_bed);
BENCHMARK_TEMPLATE(spheres_by_law, HertzMindlin<RollingResistance>)->Apply(middling_bed);
BENCHMARK(clumps)->Apply(middling_bed);
BENCHMARK(spheres_and_bucket)->Apply(middling_bed);
