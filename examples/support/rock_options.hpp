#pragma once
/// \file
/// The rock of an experiment as parameters of a program.

#include "scree/laboratory/rock_sample.hpp"
#include "support/options.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace scree::examples {

/// Binds what contacts ask of a material, as PREFIX.friction and so on.
inline void add_contact_options(Options& options, const std::string& prefix, Material& m,
                                Provenance stiffness_from, Provenance friction_from) {
  const auto of = [&](const char* field) { return prefix + "." + field; };
  options.add(of("normal_stiffness"), m.normal_stiffness, {1.0, 1e12, "N/m"}, "normal stiffness",
              stiffness_from);
  options.add(of("shear_stiffness"), m.shear_stiffness, {0.0, 1e12, "N/m"}, "shear stiffness",
              stiffness_from);
  options.add(of("friction"), m.friction, {0.0, 10.0}, "friction coefficient; a pair takes the smaller",
              friction_from);
  options.add(of("restitution"), m.restitution, {0.01, 1.0}, "restitution; a pair takes the smaller");
}

/// Shapes of the paper's Fig. 6, fractions of its Fig. 7 and sieve curves of its Fig. 8, whose numbers are
/// not in the text; material of its Table 1. At desk fidelity as `desk_rock()` has them.
class RockOptions {
public:
  explicit RockOptions(bool desk)
      : stiffness_from_{desk ? Provenance::ours : Provenance::paper},
        given_{desk ? desk_rock() : paper_rock()} {
    size_factor_ = given_.assembly.size_factor();
    const auto& parts = given_.assembly.shapes();
    for (std::size_t k = 0; k < shapes; ++k) {
      fractions_.push_back(parts[k].fraction);
      for (const double opening : openings_) {
        passing_[k].push_back(parts[k].sizes.passing(opening));
      }
    }
  }

  /// Adds all of them to a program, `rock.NAME`.
  void bind(Options& options) {
    options.group("Rock");
    options.add("rock.density", given_.rock.density, {1.0, 2e4, "kg/m3"}, "of the particles (Table 1)",
                Provenance::paper);
    add_contact_options(options, "rock", given_.rock, stiffness_from_, Provenance::paper);
    options.add("rock.stiffness_is", stiffness_, {"of_particle", "of_contact"},
                "two particles in series (the paper's convention) or the contact itself", Provenance::paper);
    options.add("rock.mass_convention", mass_convention_, {"union_of_spheres", "sum_of_spheres"},
                "how the mass of a clump is counted");
    options.add("rock.size_factor", size_factor_, {0.05, 50.0}, "on all sieve sizes; 1 is the paper's rock",
                stiffness_from_);
    options.add("rock.openings", openings_, {1e-5, 10.0, "m"}, "sieves, ascending", Provenance::paper);
    options.add("rock.fractions", fractions_, {0.0, 1.0},
                "shares by number of aligned, pyramid, flat and sphere");
    options.add("rock.sieve_basis", sieve_basis_, {"mass", "number"},
                "what the passing shares are shares of");
    for (std::size_t k = 0; k < shapes; ++k) {
      options.add(std::string{"rock.passing_"} + names[k], passing_[k], {0.0, 1.0},
                  std::string{"cumulative share of the "} + names[k] + " shape below each opening, 0 to 1");
    }
  }

  [[nodiscard]] Stiffness stiffness() const {
    return stiffness_ == "of_particle" ? Stiffness::of_particle : Stiffness::of_contact;
  }
  [[nodiscard]] MassConvention mass_convention() const { return parse_mass_convention(mass_convention_); }
  void set_mass_convention(MassConvention convention) { mass_convention_ = to_string(convention); }
  [[nodiscard]] double size_factor() const { return size_factor_; }
  void set_size_factor(double factor) { size_factor_ = factor; }
  /// N/m, of both springs.
  void set_spring(double constant) { given_.rock.normal_stiffness = given_.rock.shear_stiffness = constant; }
  [[nodiscard]] const Material& material() const { return given_.rock; }

  /// \throws Error for shares or sieves that make no distribution.
  [[nodiscard]] Assembly assembly() const {
    const auto clumps = paper_shapes(mass_convention());
    std::vector<ShapeFraction> parts;
    for (std::size_t k = 0; k < shapes; ++k) {
      parts.push_back({clumps[k], fractions_[k],
                       SieveCurve{openings_, passing_[k],
                                  sieve_basis_ == "mass" ? SieveBasis::mass : SieveBasis::number}});
    }
    return Assembly{std::move(parts), size_factor_};
  }

  /// With a rig of the material given.
  [[nodiscard]] RockSample sample(const Material& rig) const {
    return {assembly(), given_.rock, rig, stiffness()};
  }
  /// The rig that goes with this fidelity.
  [[nodiscard]] const Material& rig() const { return given_.rig; }

private:
  static constexpr std::size_t shapes = 4;
  static constexpr std::array<const char*, shapes> names{"aligned", "pyramid", "flat", "sphere"};

  Provenance stiffness_from_;
  RockSample given_;
  double size_factor_ = 1.0;
  std::string stiffness_ = "of_particle", mass_convention_ = "sum_of_spheres", sieve_basis_ = "mass";
  std::vector<double> fractions_;
  std::vector<double> openings_{0.0095, 0.0132, 0.019, 0.0265, 0.0375}; // m [paper, section 4.2]
  std::array<std::vector<double>, shapes> passing_;                     // cumulative share below each opening
};

/// Binds rock and rig to a program.
inline void bind(Options& options, RockOptions& rock, Material& rig) {
  rock.bind(options);
  options.group("What the rock touches");
  add_contact_options(options, "rig", rig, Provenance::ours, Provenance::ours);
}

/// All numbers of rock and rig as one line of JSON, under which runs with them are kept.
inline std::string text_of(RockOptions rock, Material rig) {
  Options options{"rock", ""};
  bind(options, rock, rig);
  return options.json().dump();
}

} // namespace scree::examples
