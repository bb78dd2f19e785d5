/// \file
/// Janssen (1895): the wall of a tube carries part of the weight of what fills it.

#include "ball_bed.hpp"
#include "cases.hpp"

#include "scree/contact/linear_spring.hpp"
#include "scree/measure/stress.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace validation {

namespace {

struct Quiet : scree::DefaultModel {
  static constexpr bool energy_audit = false;
};
using Bed = scree::Simulation<Quiet>;

/// The fillings, as shares of the height to which the tube is filled first; ours.
constexpr std::array<double, 7> shares{1.0, 0.75, 0.55, 0.4, 0.28, 0.18, 0.1};

/// One filling, as a mean over the time in which the bottom sinks.
struct Filling {
  double mass = 0.0;     ///< kg
  double apparent = 0.0; ///< kg, that the bottom feels
  double side = 0.0;     ///< kg, that the wall carries
  double gained = 0.0;   ///< kg, what the balls take up in momentum
};

/// What Janssen's law needs, measured in the middle of the tallest filling.
struct Middle {
  double vertical = 0.0;     ///< Pa, mean over the section
  double radial = 0.0;       ///< Pa, at the wall
  double shear = 0.0;        ///< Pa, at the wall, up on the balls
  double bulk_density = 0.0; ///< kg/m3
};

struct Tube {
  double diameter = 0.0; ///< m
  std::vector<Filling> fillings;
  Middle middle;

  /// kg, M_inf = bulk density pi D^3 / (16 K mu), with K mu of the middle.
  [[nodiscard]] double saturation() const {
    return middle.bulk_density * std::numbers::pi * std::pow(diameter, 3) * middle.vertical /
           (16.0 * middle.shear);
  }
};

/// kg, that Janssen's law gives for the bottom.
double janssen_mass(double mass, double saturation) {
  return saturation * -std::expm1(-mass / saturation);
}

/// A filled tube whose bottom sinks, so that friction holds the balls up all along the wall.
class Column {
public:
  static constexpr std::size_t side = 0, bottom = 1;

  Column(const Balls& balls, double diameter, std::size_t count, std::uint64_t seed, unsigned threads)
      : balls_{balls},
        diameter_{diameter},
        bed_{{.stiffness = scree::Stiffness::of_contact,
              .gravity = {0.0, 0.0, -balls.g},
              .local_damping = 0.3,
              .threads = threads}} {
    const auto glass = bed_.add_material(balls.material());
    bed_.add_wall({.name = "side",
                   .surfaces = {{scree::Cylinder{.radius = 0.5 * diameter}, glass}},
                   .dynamics = scree::Fixed{}});
    bed_.add_wall({.name = "bottom", .surfaces = {{scree::Plane{}, glass}}, .dynamics = sinking(0.0)});
    scree::Random random{seed, "janssen"};
    bed_.add(balls_in_tube(balls, count, 0.5 * diameter, random, glass));
    scree::run_for(bed_, 2.0 * std::sqrt(2.0 * top() / balls.g));
    (void)come_to_rest(bed_, 1e-3, 100.0 * balls.time(), balls.time());
    bed_.set_local_damping(0.0); // as it would carry weight
  }

  Tube measure() {
    Tube out{diameter_, {}, {}};
    const double height = top();
    bed_.dynamics<scree::Prescribed>(bottom) = sinking(speed());
    sink(1.0, nullptr);
    for (const double share : shares) {
      const double lid = floor() + share * height;
      bed_.remove_bodies([lid](const auto& bodies, std::size_t b) { return bodies.position(b).z() > lid; });
      sink(share < 1.0 ? 0.25 : 0.0, nullptr);
      out.fillings.push_back(sink(0.5, share < 1.0 ? nullptr : &out.middle));
    }
    return out;
  }

private:
  /// m/s; ours: the weight of a ball stops it within a thousandth of its diameter.
  [[nodiscard]] double speed() const { return 0.04 * std::sqrt(balls_.g * balls_.diameter); }

  [[nodiscard]] scree::Prescribed sinking(double speed) const {
    const double z = bed_.walls().size() > bottom ? floor() : 0.0, start = bed_.time();
    return scree::Prescribed{[=](double time) {
      return scree::Pose{{0.0, 0.0, z - speed * (time - start)}};
    }};
  }

  [[nodiscard]] double floor() const { return bed_.wall(bottom).motion.position.z(); }
  [[nodiscard]] double top() const {
    double most = 0.0;
    for (std::size_t b = 0; b < bed_.bodies().size(); ++b) {
      most = std::max(most, bed_.bodies().position(b).z());
    }
    return most;
  }
  [[nodiscard]] double momentum() const {
    double sum = 0.0;
    for (std::size_t b = 0; b < bed_.bodies().size(); ++b) {
      sum += bed_.bodies().mass(b) * bed_.bodies().velocity(b).z();
    }
    return sum;
  }

  /// Lets the bottom sink by some diameters and takes means over that time.
  Filling sink(double diameters, Middle* middle) {
    const double start = bed_.time(), before = momentum();
    const double on_bottom = bed_.wall(bottom).load.impulse.z(), on_side = bed_.wall(side).load.impulse.z();
    std::vector<Middle> samples;
    scree::run_for(bed_, diameters * balls_.diameter / speed(), scree::Every{balls_.time(), [&](const Bed&) {
                                                                               if (middle != nullptr) {
                                                                                 samples.push_back(look());
                                                                               }
                                                                             }});
    for (const Middle& sample : samples) {
      const double share = 1.0 / static_cast<double>(samples.size());
      middle->vertical += share * sample.vertical;
      middle->radial += share * sample.radial;
      middle->shear += share * sample.shear;
      middle->bulk_density += share * sample.bulk_density;
    }
    const double weight_of_kg = balls_.g * (bed_.time() - start); // N s
    return {mass_where(bed_, [](const scree::Vector&) { return true; }),
            (on_bottom - bed_.wall(bottom).load.impulse.z()) / weight_of_kg,
            (on_side - bed_.wall(side).load.impulse.z()) / weight_of_kg,
            (momentum() - before) / weight_of_kg};
  }

  /// Half of the height, in the middle: away from the bottom and from the surface.
  [[nodiscard]] Middle look() const {
    const double height = top() - floor();
    const double low = floor() + 0.25 * height, high = floor() + 0.75 * height, r = 0.5 * diameter_;
    const double section = std::numbers::pi * r * r, mantle = 2.0 * std::numbers::pi * r * (high - low);
    const Eigen::AlignedBox3d box{scree::Vector{-r, -r, low}, scree::Vector{r, r, high}};
    Middle out;
    out.vertical = scree::mean_stress(bed_, box)(2, 2) * box.volume() / (section * (high - low));
    bed_.visit_contacts([&](const scree::ContactView& c) {
      if (c.with_wall && c.second == side && c.point.z() >= low && c.point.z() < high) {
        out.radial += c.force.dot(c.normal) / mantle;
        out.shear += c.force.z() / mantle;
      }
    });
    out.bulk_density =
        mass_where(bed_, [&](const scree::Vector& at) { return at.z() >= low && at.z() < high; }) /
        (section * (high - low));
    return out;
  }

  Balls balls_;
  double diameter_;
  Bed bed_;
};

/// kg, the saturation with which Janssen's law is nearest to the fillings, by golden section.
double fitted_saturation(const std::vector<Filling>& fillings) {
  const auto misfit = [&](double saturation) {
    double sum = 0.0;
    for (const Filling& f : fillings) {
      const double off = f.apparent - janssen_mass(f.mass, saturation);
      sum += off * off;
    }
    return sum;
  };
  double low = 0.01 * fillings.front().mass, high = 10.0 * fillings.front().mass;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (high - low > 1e-9 * high) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (misfit(a) < misfit(b) ? high : low) = misfit(a) < misfit(b) ? b : a;
  }
  return 0.5 * (low + high);
}

} // namespace

Outcome janssen(const Inputs& inputs) {
  const char* name = "Janssen";
  constexpr double sigmas = 3.0;
  const Balls balls;
  const double diameter = (inputs.full ? 16.0 : 8.0) * balls.diameter;
  const std::size_t count = inputs.full ? 11200 : 1400; // to about three diameters
  const std::uint64_t seeds = inputs.full ? 8 : 4;
  std::vector<Tube> tubes;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    tubes.push_back(Column{balls, diameter, count, seed, inputs.threads}.measure());
  }
  const auto over_tubes = [&](auto value) {
    std::vector<double> values;
    for (const Tube& tube : tubes) {
      values.push_back(value(tube));
    }
    return Mean{values};
  };
  Outcome out;
  const Filling& whole = tubes.front().fillings.front();
  out.add(name, "what bottom and side carry over weight, less the gain in momentum", "1", 1.0,
          {Origin::theory, "momentum of all balls"},
          (whole.apparent + whole.side - whole.gained) / whole.mass, {1e-9, true, "rounding of sums"});

  Series found{"scree", Origin::code, {}, {}};
  Series expected{"Janssen with K and friction as measured", Origin::theory, {}, {}};
  Series weight{"all of it", Origin::theory, {}, {}};
  const double kg = 1e3; // g
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const Mean ratio = over_tubes([k](const Tube& tube) {
      const Filling& f = tube.fillings[k];
      return f.apparent / janssen_mass(f.mass, tube.saturation());
    });
    const Mean mass = over_tubes([k](const Tube& tube) { return tube.fillings[k].mass; });
    const Mean apparent = over_tubes([k](const Tube& tube) { return tube.fillings[k].apparent; });
    const Mean theory =
        over_tubes([k](const Tube& tube) { return janssen_mass(tube.fillings[k].mass, tube.saturation()); });
    out.add(name, fmt::format("apparent over Janssen's mass, filled to {:g}", shares[k]), "1", 1.0,
            {Origin::theory, "M_inf (1 - exp(-M / M_inf)), M_inf from K and wall friction as measured"},
            ratio.value,
            {sigmas * ratio.standard_error, true,
             fmt::format("{:g} standard errors over {} tubes", sigmas, tubes.size())});
    found.x.push_back(kg * mass.value);
    found.y.push_back(kg * apparent.value);
    expected.x.push_back(kg * mass.value);
    expected.y.push_back(kg * theory.value);
    weight.x.push_back(kg * mass.value);
    weight.y.push_back(kg * mass.value);
  }
  const Mean growth =
      over_tubes([](const Tube& tube) { return tube.fillings[0].apparent / tube.fillings[1].apparent; });
  const Mean left =
      over_tubes([](const Tube& tube) { return std::exp(-tube.fillings[1].mass / tube.saturation()); });
  out.add(name, "apparent mass, filled to 1 over filled to 0.75", "1", 1.0, {Origin::theory, "saturation"},
          growth.value,
          {sigmas * growth.standard_error + left.value, true,
           fmt::format("{:g} standard errors over {} tubes, and exp(-M / M_inf)", sigmas, tubes.size())});
  const Mean fit =
      over_tubes([](const Tube& tube) { return fitted_saturation(tube.fillings) / tube.saturation(); });
  out.add(name, "saturation mass, fitted to the fillings over that from K and friction", "1", 1.0,
          {Origin::theory, "M_inf = bulk density pi D^3 / (16 K mu)"}, fit.value,
          {sigmas * fit.standard_error, true,
           fmt::format("{:g} standard errors over {} tubes", sigmas, tubes.size())});
  const Mean k = over_tubes([](const Tube& tube) { return tube.middle.radial / tube.middle.vertical; });
  const Mean mu = over_tubes([](const Tube& tube) { return tube.middle.shear / tube.middle.radial; });
  out.notes.push_back(fmt::format("Janssen: the tube is {:g} balls wide; in the middle of the tallest "
                                  "filling K = radial at the wall over "
                                  "vertical stress = {:.3f} +- {:.3f} and the wall friction that holds is "
                                  "{:.3f} +- {:.3f} of {:g} that it "
                                  "could be. All numbers of the set-up are ours.",
                                  diameter / balls.diameter, k.value, k.standard_error, mu.value,
                                  mu.standard_error, balls.friction));
  out.draw({"janssen",
            name,
            "mass of the filling, g",
            "mass that the bottom feels, g",
            {expected, weight},
            {found}});
  return out;
}

} // namespace validation
