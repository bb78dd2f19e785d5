// How long does a contact law take for one contact?

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/linear_spring.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/core/linear.hpp"
#include "scree/core/random.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace {

using namespace scree;

constexpr std::size_t contact_count = 256; // with their history they stay in the first-level cache

PairMaterial<double> rock() {
  const Material m{.normal_stiffness = 1e5,
                   .shear_stiffness = 1e5,
                   .youngs_modulus = 1e8,
                   .friction = 0.5,
                   .restitution = 0.5,
                   .rolling_friction = 0.1};
  return mix(m, m, Stiffness::of_contact);
}

template <class Law, class Real>
struct Contacts {
  std::vector<Kinematics<Real>> kinematics;
  std::vector<std::array<Real, static_cast<std::size_t>(Law::history_size)>> history;
};

/// Pressed by 2 um; of each hundred, `sliding` move along the contact fast enough to slide in every step, and
/// the others are at rest with a spring below the limit.
template <class Law, class Real>
Contacts<Law, Real> made_contacts(std::int64_t sliding) {
  Random random{7};
  const auto direction = [&random] { return Vector(random.orientation() * Vector::UnitX()); };
  Contacts<Law, Real> out;
  for (std::size_t c = 0; c < contact_count; ++c) {
    const Vector normal = direction();
    const Vector along = normal.cross(direction()).normalized();
    const bool slides = static_cast<std::int64_t>(c * 37 % 100) < sliding;
    Kinematics<Real> k;
    k.normal = to_vec3<Real>(normal);
    k.overlap = Real(2e-6);
    k.velocity = slides ? to_vec3<Real>(Vector(0.5 * along)) : Vec3<Real>{};
    k.spin_i = k.spin_j = to_vec3<Real>(Vector(0.01 * direction()));
    k.reduced_radius = Real(3.5e-3);
    k.reduced_mass = Real(1e-3);
    k.root_mass = std::sqrt(k.reduced_mass);
    k.dt = Real(1e-5);
    out.kinematics.push_back(k);
    out.history.push_back({});
    for (std::size_t d = 0; d < 3; ++d) {
      out.history.back()[d] = static_cast<Real>(1e-3 * along[static_cast<int>(d)]);
    }
  }
  return out;
}

template <class Law, class Real>
void one_contact(benchmark::State& state) {
  Contacts<Law, Real> contacts = made_contacts<Law, Real>(state.range(0));
  const auto pair = rock().template as<Real>();
  const Law law{};
  Real work{};
  for (auto _ : state) {
    Vec3<Real> sum{};
    for (std::size_t c = 0; c < contact_count; ++c) {
      const Kinematics<Real>& k = contacts.kinematics[c];
      const ContactForce<Real> f = law.evaluate(pair, k, contacts.history[c]);
      sum += k.normal * f.normal + f.tangential + f.couple;
      work += f.frictional_work;
    }
    benchmark::DoNotOptimize(sum);
  }
  if ((work > Real(0)) != (state.range(0) > 0)) {
    state.SkipWithError("the contacts do not slide as they should");
  }
  state.counters["contact"] =
      benchmark::Counter(static_cast<double>(contact_count),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

} // namespace

using RollingLinear = LinearSpring<RollingResistance>;
using RollingHertz = HertzMindlin<RollingResistance>;

#define SCREE_LAW(law, real)                                                                                 \
  BENCHMARK_TEMPLATE(one_contact, law, real)->ArgName("sliding_percent")->Arg(0)->Arg(10)->Arg(50)->Arg(100)
SCREE_LAW(LinearSpring<>, double);
SCREE_LAW(LinearSpring<>, float);
SCREE_LAW(RollingLinear, double);
SCREE_LAW(RollingLinear, float);
SCREE_LAW(HertzMindlin<>, double);
SCREE_LAW(HertzMindlin<>, float);
SCREE_LAW(RollingHertz, double);
SCREE_LAW(RollingHertz, float);
