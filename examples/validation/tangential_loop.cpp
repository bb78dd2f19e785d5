/// \file
/// Tangential loading, unloading and reloading of a contact under a constant normal force: the loops of both
/// laws against their closed forms, and Mindlin's law beside the partial slip of Mindlin & Deresiewicz
/// (1953).

#include "cases.hpp"
#include "impact.hpp"
#include "law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace validation {

namespace {

constexpr double radius = 0.01, overlap = 1e-5, mu = 0.4, dt = 1e-6;
constexpr int leg = 1000; // steps from the middle to the amplitude

/// A point of the path of the plane under the sphere.
struct Drive {
  double along, rise; ///< m, tangential and towards the sphere
};

struct LoopPoint {
  double displacement, force, normal; ///< m, N, N
  double lost;                        ///< J, by friction since the start
};

/// Ours: the closed forms hold for any.
const scree::Material rock{.density = 1e15, // so heavy that the contact does not move it
                           .normal_stiffness = 1e6,
                           .shear_stiffness = 8e5,
                           .youngs_modulus = 1e9,
                           .poisson_ratio = 0.3,
                           .friction = mu,
                           .restitution = 1.0};

/// Moves a plane along a path under a sphere that stays, by one step from point to point.
template <class Law>
std::vector<LoopPoint> drive(std::vector<Drive> path) {
  // The first force is that of the velocity of the first move; so the path begins with a step at rest.
  path.insert(path.begin(), path.front());
  scree::Simulation<With<Law>> sim{
      {.stiffness = scree::Stiffness::of_contact, .gravity = scree::Vector::Zero(), .time_step = dt}};
  const auto id = sim.add_material(rock);
  const auto shape = scree::make_clump("ball", std::vector<scree::Sphere>{{scree::Vector::Zero(), radius}});
  sim.add({.clump = &shape, .material = id, .position = {0.0, 0.0, radius - overlap}});
  sim.add_wall({.name = "plane",
                .surfaces = {{scree::Plane{}, id}},
                .dynamics = scree::Prescribed{[&path](double time) {
                  const auto k = std::min(static_cast<std::size_t>(std::lround(time / dt)), path.size() - 1);
                  return scree::Pose{{path[k].along, 0.0, path[k].rise}};
                }}});
  std::vector<LoopPoint> out;
  for (const Drive& at : path) {
    sim.set_motion(0, scree::Vector::Zero(), scree::Vector::Zero());
    sim.step();
    sim.visit_contacts([&](const scree::ContactView& c) {
      out.push_back({at.along, c.force.x(), c.force.z(), sim.dissipation().friction});
    });
  }
  return out;
}

/// From the middle to `amplitude`, then `loops` times to the other side and back.
std::vector<Drive> zigzag(double amplitude, int loops) {
  std::vector<Drive> path;
  for (int k = 0; k <= leg; ++k) {
    path.push_back({amplitude * k / leg, 0.0});
  }
  for (int half = 0; half < 2 * loops; ++half) {
    const double side = half % 2 == 0 ? 1.0 : -1.0;
    for (int k = 1; k <= 2 * leg; ++k) {
      path.push_back({side * amplitude * (1.0 - static_cast<double>(k) / leg), 0.0});
    }
  }
  return path;
}

/// The spring of a law at constant overlap and what it slides at.
struct Foot {
  double stiffness, limit; ///< N/m, N
  [[nodiscard]] double knee() const { return limit / stiffness; }
};

template <class Law>
Foot foot() {
  if constexpr (!is_hertz<Law>) {
    return {rock.shear_stiffness, mu * rock.normal_stiffness * overlap};
  }
  const double shear = rock.youngs_modulus / (4.0 * (1.0 + rock.poisson_ratio) * (2.0 - rock.poisson_ratio));
  const double a = std::sqrt(radius * overlap);
  return {8.0 * shear * a, mu * 4.0 / 3.0 * effective_modulus(rock, rock) * a * overlap};
}

template <class Law>
void loops_by(Outcome& out) {
  const Foot at = foot<Law>();
  const Source bilinear{Origin::theory, "k_s times displacement, at most mu F_n"};
  const Tolerance exact{1e-9, true,
                        "a law in increments of the displacement has no error of the step: rounding"};
  for (const double share : {0.8, 1.5, 4.0}) {
    const double amplitude = share * at.knee();
    const std::string name = fmt::format("tangential loops to {:g} mu F_n / k_s, {}", share, law_name<Law>);
    const auto points = drive<Law>(zigzag(amplitude, 2));
    double worst = 0.0, off_normal = 0.0, expected = 0.0, before = 0.0, area = 0.0;
    Series found{std::string{"scree, "} + law_name<Law>, Origin::code, {}, {}},
        theory{"bilinear", Origin::theory, {}, {}};
    // The closed form goes from turning point to turning point.
    for (std::size_t k = 0; k < points.size(); ++k) {
      const LoopPoint& p = points[k];
      expected = std::clamp(expected + at.stiffness * (p.displacement - before), -at.limit, at.limit);
      before = p.displacement;
      worst = std::max(worst, std::abs(p.force - expected) / at.limit);
      off_normal = std::max(off_normal, std::abs(mu * p.normal / at.limit - 1.0));
      found.x.push_back(p.displacement / at.knee());
      found.y.push_back(p.force / at.limit);
      if (k % 100 == 0) {
        theory.x.push_back(p.displacement / at.knee());
        theory.y.push_back(expected / at.limit);
      }
      if (k + 4 * leg >= points.size()) { // the last loop
        area += 0.5 * (p.force + points[k - 1].force) * (p.displacement - points[k - 1].displacement);
      }
    }
    out.add(name, "largest distance from the closed form over mu F_n", "1", 0.0, bilinear, worst,
            {exact.size, false, exact.grounds});
    out.add(name, "largest change of the normal force", "1", 0.0, {Origin::theory, "constant overlap"},
            off_normal, {exact.size, false, exact.grounds});
    const double loss = 4.0 * at.limit * std::max(0.0, amplitude - at.knee());
    const double lost = points.back().lost - points[points.size() - 1 - 4 * leg].lost;
    const Source loop{Origin::theory, "4 mu F_n (amplitude - mu F_n / k_s)"};
    const double unit = at.limit * at.knee();
    out.add(name, "friction's work in a loop over (mu F_n)^2 / k_s", "1", loss / unit, loop, lost / unit,
            {exact.size, false, exact.grounds});
    // The trapezium is off by a triangle in each of two steps in which it begins to slide.
    out.add(name, "area of a loop over (mu F_n)^2 / k_s", "1", loss / unit, loop, area / unit,
            {2.0 * std::pow(share / leg, 2), false, "trapezia over the two steps in which sliding begins"});
    out.draw({fmt::format("tangential_loop_{:g}_{}", share, law_name<Law>),
              name,
              "displacement k_s / (mu F_n)",
              "tangential force / (mu F_n)",
              {theory},
              {found}});
  }
}

/// Loaded, the normal force taken off to an eighth and put on again at the same displacement.
void unloading(Outcome& out) {
  const Foot at = foot<scree::HertzMindlin<>>();
  const char* name = "Mindlin's spring under a falling normal force";
  const double reached = 0.05 * at.knee(); // below mu F_n all the while
  std::vector<Drive> path;
  for (int k = 0; k <= leg; ++k) {
    path.push_back({reached * k / leg, 0.0});
  }
  for (int k = 1; k <= 2 * leg; ++k) {
    path.push_back({reached, -0.75 * overlap * (1.0 - std::abs(1.0 - static_cast<double>(k) / leg))});
  }
  const auto points = drive<scree::HertzMindlin<>>(path);
  const double full = at.stiffness * reached;
  const Source reduced{Origin::theory, "reduced with the stiffness, Thornton, Cummins & Cleary (2013)"};
  const Tolerance exact{1e-9, true, "a product of ratios of neighbouring steps: rounding"};
  out.add(name, "force at a quarter of the overlap over that before", "1", 0.5, reduced,
          points[2 * leg + 1].force / full, exact);
  out.add(name, "force at the full overlap again over that before", "1", 0.5, reduced,
          points[3 * leg + 1].force / full, exact);
  out.add(name, "energy lost over F^2 / k_s", "1", 0.375,
          {Origin::theory, "springs' energy before less that after, 1/2 - 1/8"},
          points.back().lost / (full * reached),
          {1.5 / leg, true, "first order of the steps of the overlap"});
}

/// Partial slip: an annulus of the contact slides before all of it does.
void partial_slip(Outcome& out) {
  const Foot at = foot<scree::HertzMindlin<>>();
  const char* name = "Mindlin's law beside partial slip";
  const char* why = "no partial slip in this law: Mindlin's stiffness without slip up to mu F_n";
  const Source source{Origin::theory, "Mindlin & Deresiewicz (1953), constant normal force"};
  const Tolerance rounding{1e-6, true, "constant normal force, where the theory is in closed form"};
  // They slide as a whole from here on; the law of scree from `knee`.
  const double whole = 1.5 * at.knee();
  const auto points = drive<scree::HertzMindlin<>>(zigzag(whole, 2));
  Series found{"scree, Hertz-Mindlin", Origin::code, {}, {}}, theory{"partial slip", Origin::theory, {}, {}};
  for (const LoopPoint& p : points) {
    found.x.push_back(p.displacement / at.knee());
    found.y.push_back(p.force / at.limit);
  }
  const auto force = [](double x) { return 1.0 - std::pow(1.0 - x, 1.5); }; // loading; x of `whole`
  for (int k = 0; k <= 50; ++k) {
    theory.x.push_back(1.5 * k / 50);
    theory.y.push_back(force(k / 50.0));
  }
  for (int k = 0; k <= 200; ++k) {
    const double x = std::abs(1.0 - k / 100.0) * 2.0 - 1.0; // back and forth
    theory.x.push_back(1.5 * x);
    theory.y.push_back(k <= 100 ? 1.0 - 2.0 * force(0.5 * (1.0 - x)) : 2.0 * force(0.5 * (1.0 + x)) - 1.0);
  }
  const auto near = [&](double displacement) {
    return *std::min_element(points.begin(), points.begin() + leg, [&](const auto& a, const auto& b) {
      return std::abs(a.displacement - displacement) < std::abs(b.displacement - displacement);
    });
  };
  const LoopPoint small = near(1e-2 * whole), knee = near(at.knee());
  // 1 - (1 - x)^(3/2) = 3/2 x (1 - x/4 ...)
  out.add(name, "force at 1/100 of the displacement of full slip over mu F_n", "1",
          force(small.displacement / whole), source, small.force / at.limit,
          {0.3 * small.displacement / whole, true, "first order of the displacement: x/4 of full slip's"});
  out.add(name, "force at the displacement mu F_n / k_s over mu F_n", "1", force(knee.displacement / whole),
          source, knee.force / at.limit, rounding, why);
  const double unit = at.limit * at.knee();
  // The area between the branches: 3/2 (8 I - 4) with I = 3/5, the integral of `force` from 0 to 1.
  out.add(name, "loss of a loop to 3/2 mu F_n / k_s over (mu F_n)^2 / k_s", "1", 1.2, source,
          (points.back().lost - points[points.size() - 1 - 4 * leg].lost) / unit, rounding, why);
  out.draw({"tangential_partial_slip",
            name,
            "displacement k_s / (mu F_n)",
            "tangential force / (mu F_n)",
            {theory},
            {found}});
}

} // namespace

/// A plane that is moved to and fro under a sphere at constant overlap.
Outcome tangential_loop(const Inputs& /*inputs*/) {
  Outcome out;
  loops_by<scree::LinearSpring<>>(out);
  loops_by<scree::HertzMindlin<>>(out);
  unloading(out);
  partial_slip(out);
  out.notes.push_back(
      "Tangential loops: material, radius and overlap are ours, as the closed forms hold for any. "
      "The theory of partial slip is that of two elastic spheres at rest otherwise; scree's law "
      "has its stiffness at the first slip and its limit, not the bend between.");
  return out;
}

} // namespace validation
