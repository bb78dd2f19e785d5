#pragma once
/// \file
/// Bulk density of a filled container (Coetzee et al. 2010, section 4.3).

#include "scree/core/random.hpp"
#include "scree/laboratory/round_container.hpp"
#include "scree/simulation/simulation.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace scree {

struct BulkDensitySetup {
  RockSample sample = paper_rock();
  RoundContainer container{};
  FillRecipe fill{};
  std::uint64_t slices = 10; ///< of the profile over the height, 1 or more
  std::uint64_t seed = 1;
  unsigned threads = 0; ///< 0: one for each processor
};

/// The desk version: fewer, larger and softer grains in a smaller container. All ours.
inline BulkDensitySetup desk_bulk_density() {
  return {.sample = desk_rock(), .container = {.radius = 0.15, .height = 0.15}};
}

/// A filling over a tenth, say, of the height.
struct DensitySlice {
  double height = 0.0;  ///< m, of its middle above the floor
  double density = 0.0; ///< kg/m3
};

struct BulkDensityResult {
  double bulk_density = 0.0; ///< kg/m3, of what is left after striking off over the volume to the brim
  double mass = 0.0;         ///< kg
  double porosity = 0.0;     ///< of the container, by the solid that the clumps' spheres cover together
  std::vector<DensitySlice> profile{}; ///< from the floor up
  FillReport fill{};
};

/// Fills a container and weighs it.
///
///     scree::BulkDensityTest<> test{scree::desk_bulk_density()};
///     const double density = test.run().bulk_density;
template <class Model = DefaultModel>
class BulkDensityTest {
public:
  using Sim = Simulation<Model>;
  using Setting = BulkDensitySetup;
  using Result = BulkDensityResult;

  /// \throws Error for a parameter out of its range.
  explicit BulkDensityTest(BulkDensitySetup setup, Setup<Model> physics = {})
      : setup_{std::move(setup)},
        simulation_{with_sample(std::move(physics), setup_.sample, setup_.threads)} {
    setup_.container.check();
    setup_.fill.check();
    require("slices of the density profile", static_cast<double>(setup_.slices), {1.0, 1e6});
    rock_ = simulation_.add_material(setup_.sample.rock);
    const MaterialId rig = simulation_.add_material(setup_.sample.rig);
    simulation_.add_wall({.name = "mantle", .surfaces = setup_.container.mantle(rig), .dynamics = Fixed{}});
    simulation_.add_wall({.name = "floor", .surfaces = RoundContainer::floor(rig), .dynamics = Fixed{}});
  }

  /// Once. `watch(simulation, Stage)` is called after every step.
  template <class Watch>
  const BulkDensityResult& run(Watch watch) {
    once_.begin("bulk density");
    Random random{setup_.seed, "filling"};
    result_.fill = fill_container(simulation_, setup_.container, setup_.sample.assembly, rock_, setup_.fill,
                                  random, watch);
    result_.bulk_density = result_.fill.bulk_density;
    result_.mass = result_.fill.mass;
    weigh_slices();
    return result_;
  }
  const BulkDensityResult& run() {
    return run([](const auto&, const Stage&) {});
  }

  [[nodiscard]] const BulkDensitySetup& setup() const { return setup_; }
  [[nodiscard]] const BulkDensityResult& result() const { return result_; }
  [[nodiscard]] const Sim& simulation() const { return simulation_; }

private:
  /// Every grain's mass is spread over its spheres as their volumes are, and cut where slices meet.
  void weigh_slices() {
    const auto& bodies = simulation_.bodies();
    const double thick = setup_.container.height / static_cast<double>(setup_.slices);
    std::vector<double> mass(setup_.slices, 0.0);
    double solid = 0.0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      double volume = 0.0;
      for (std::size_t s = bodies.first_sphere(b); s < bodies.first_sphere(b + 1); ++s) {
        volume += sphere_volume(bodies.spheres()[s].radius);
      }
      for (std::size_t s = bodies.first_sphere(b); s < bodies.first_sphere(b + 1); ++s) {
        const auto& sphere = bodies.spheres()[s];
        const double share = bodies.mass(b) / volume;
        for (std::size_t k = 0; k < setup_.slices; ++k) {
          const double low = thick * static_cast<double>(k) - sphere.position.z;
          mass[k] += share * (volume_below(low + thick, sphere.radius) - volume_below(low, sphere.radius));
        }
      }
      solid += bodies.solid_volume(b);
    }
    for (std::size_t k = 0; k < setup_.slices; ++k) {
      result_.profile.push_back(
          {thick * (static_cast<double>(k) + 0.5), mass[k] / (thick * setup_.container.area())});
    }
    result_.porosity = 1.0 - solid / setup_.container.volume();
  }

  static double sphere_volume(double radius) { return volume_below(radius, radius); }
  /// m3, of a sphere about the origin below height `z`.
  static double volume_below(double z, double radius) {
    const double h = std::clamp(z, -radius, radius) + radius;
    return std::numbers::pi * h * h * (radius - h / 3.0);
  }

  BulkDensitySetup setup_;
  RunsOnce once_;
  Sim simulation_;
  MaterialId rock_ = 0;
  BulkDensityResult result_;
};

} // namespace scree
