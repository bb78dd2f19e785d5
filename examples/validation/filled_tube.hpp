#pragma once
/// \file
/// A tube filled with balls, as Janssen (1895) has it.

#include "ball_bed.hpp"

#include "scree/measure/stress.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace validation {

/// The fillings, as shares of the height to which the tube is filled first; ours.
inline constexpr std::array<double, 7> shares{1.0, 0.75, 0.55, 0.4, 0.28, 0.18, 0.1};

/// One filling, as a mean over the time in which the bottom sinks.
struct Filling {
  double mass = 0.0;     ///< kg
  double apparent = 0.0; ///< kg, that the bottom feels
  double side = 0.0;     ///< kg, that the wall carries
  double gained = 0.0;   ///< kg, what the balls take up in momentum
};

/// What Janssen's law needs, measured between two heights of the tallest filling.
struct Slice {
  double vertical = 0.0;     ///< Pa, mean over the section
  double radial = 0.0;       ///< Pa, at the wall
  double shear = 0.0;        ///< Pa, at the wall, up on the balls
  double bulk_density = 0.0; ///< kg/m3

  void add(const Slice& other, double share) {
    vertical += share * other.vertical;
    radial += share * other.radial;
    shear += share * other.shear;
    bulk_density += share * other.bulk_density;
  }
};

struct Tube {
  double diameter = 0.0; ///< m
  std::vector<Filling> fillings;
  Slice foot, middle; ///< the lowest quarter of the height, and the two above it

  /// kg, M_inf = bulk density pi D^3 / (16 K mu), with K mu of a slice.
  [[nodiscard]] double saturation(const Slice& slice) const {
    return slice.bulk_density * std::numbers::pi * std::pow(diameter, 3) * slice.vertical /
           (16.0 * slice.shear);
  }
  [[nodiscard]] double saturation() const { return saturation(middle); }
};

/// kg, that Janssen's law gives for the bottom.
inline double janssen_mass(double mass, double saturation) {
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
    (void)come_to_rest(bed_, 0.02, 100.0 * balls.time(), balls.time());
    bed_.set_local_damping(0.0); // as it would carry weight
  }

  Tube measure() {
    Tube out{diameter_, {}, {}, {}};
    const double height = top();
    bed_.dynamics<scree::Prescribed>(bottom) = sinking(speed());
    sink(0.75, nullptr);
    for (const double share : shares) {
      const double lid = floor() + share * height;
      bed_.remove_bodies([lid](const auto& bodies, std::size_t b) { return bodies.position(b).z() > lid; });
      sink(share < 1.0 ? 0.25 : 0.0, nullptr);
      out.fillings.push_back(sink(share > 0.5 ? 1.0 : 0.5, share < 1.0 ? nullptr : &out));
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
  Filling sink(double diameters, Tube* tube) {
    const double start = bed_.time(), before = momentum();
    const double on_bottom = bed_.wall(bottom).load.impulse.z(), on_side = bed_.wall(side).load.impulse.z();
    std::vector<std::pair<Slice, Slice>> samples; // foot, middle
    scree::run_for(bed_, diameters * balls_.diameter / speed(),
                   scree::Every{balls_.time(), [&](const auto&) {
                                  if (tube != nullptr) {
                                    samples.push_back({look(0.0, 0.25), look(0.25, 0.75)});
                                  }
                                }});
    for (const auto& [foot, middle] : samples) {
      const double share = 1.0 / static_cast<double>(samples.size());
      tube->foot.add(foot, share);
      tube->middle.add(middle, share);
    }
    const double weight_of_kg = balls_.g * (bed_.time() - start); // N s
    return {mass_where(bed_, [](const scree::Vector&) { return true; }),
            (on_bottom - bed_.wall(bottom).load.impulse.z()) / weight_of_kg,
            (on_side - bed_.wall(side).load.impulse.z()) / weight_of_kg,
            (momentum() - before) / weight_of_kg};
  }

  /// \param from, to shares of the height
  [[nodiscard]] Slice look(double from, double to) const {
    const double height = top() - floor(), r = 0.5 * diameter_;
    const double low = floor() + from * height, high = floor() + to * height;
    const double section = std::numbers::pi * r * r, mantle = 2.0 * std::numbers::pi * r * (high - low);
    const Eigen::AlignedBox3d box{scree::Vector{-r, -r, low}, scree::Vector{r, r, high}};
    Slice out;
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
  scree::Simulation<Quiet> bed_;
};

} // namespace validation
