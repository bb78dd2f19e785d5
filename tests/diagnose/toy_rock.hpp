#pragma once
/// \file
/// A rock whose experiments are formulas, with a few causes that move them as such causes do.

#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/response_surface.hpp"
#include "scree/core/random.hpp"
#include "scree/diagnose/cause.hpp"
#include "scree/diagnose/shared_design.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace toy {

struct Observable {
  const char *name, *specimens;
  bool logarithmic;
};
inline constexpr std::array observables{Observable{"solid density", "immersion", true},
                                        Observable{"bulk density", "container", true},
                                        Observable{"tamped density", "tamped", true},
                                        Observable{"modulus", "oedometer", true},
                                        Observable{"unloading modulus", "oedometer", true},
                                        Observable{"settlement", "oedometer", true},
                                        Observable{"angle", "heap", false},
                                        Observable{"tilt", "tilt", false},
                                        Observable{"restitution", "drop", true},
                                        Observable{"angle of another heap", "held heap", false},
                                        Observable{"modulus under more load", "held oedometer", true}};
inline constexpr std::size_t held_out = 2; // the last of them

inline const std::vector<scree::Parameter>& base() {
  static const std::vector<scree::Parameter> space{{"particle_density", "kg/m3", 1100.0, 2300.0, true},
                                                   {"normal_stiffness", "N/m", 4e4, 2.5e5, true},
                                                   {"friction", "", 0.15, 0.9, false}};
  return space;
}
inline std::vector<scree::Cause> causes() {
  return {{"rolling_resistance", {{"rolling_friction", "", 0.0, 0.5}}, {0.0}},
          {"adhesion", {{"adhesion", "J/m2", 0.0, 4.0}}, {0.0}},
          {"normal_hysteresis", {{"unloading_ratio", "", 1.0, 3.0}}, {1.0}},
          {"damping", {{"restitution", "", 0.15, 0.95}}, {0.6}}};
}

/// \param p density, stiffness, friction, rolling friction, adhesion, unloading ratio, restitution
/// \param noise of single specimens; 1 is usual
/// \param outside an effect that is none of the causes: the balance of the container reads too much
inline std::vector<double> observed(const std::vector<double>& p, scree::Random& random, double noise,
                                    double outside = 0.0) {
  const double friction = p[2], rolling = 2.0 * p[3], adhesion = 0.25 * p[4], ratio = p[5],
               restitution = p[6];
  const double slip = 1.0 - std::exp(-2.0 * friction);
  const double porosity = 0.40 + 0.05 * slip + 0.05 * rolling + 0.06 * adhesion * adhesion;
  const double modulus = std::pow(p[1], 0.9) * (1.0 - 1.2 * porosity);
  const auto off = [&](double relative) { return 1.0 + noise * relative * random.normal(); };
  const auto aside = [&](double degrees) { return noise * degrees * random.normal(); };
  return {p[0] * off(5e-4),
          p[0] * (1.0 - porosity) * (1.0 + outside) * off(2e-3),
          p[0] * (1.0 - porosity + 0.04 * (1.0 - rolling)) * (1.0 + outside) * off(2e-3),
          modulus * off(0.02),
          1.2 * modulus * (1.0 + 0.8 * (ratio - 1.0)) * off(0.02),
          1.25 / modulus * (1.0 - 0.2 * rolling - 0.1 * adhesion) * off(0.03),
          15.0 + 25.0 * slip + 12.0 * rolling / (1.0 + friction) + 9.0 * adhesion + aside(0.7),
          10.0 + 35.0 * slip + 16.0 * rolling + 2.0 * adhesion + aside(1.0),
          restitution / (1.0 + 0.4 * (ratio - 1.0)) * off(0.01),
          17.0 + 25.0 * slip + 12.0 * rolling / (1.0 + friction) + 4.0 * adhesion + aside(0.7),
          1.5 * modulus * (1.0 + 0.05 * (ratio - 1.0)) * off(0.02)};
}

inline std::vector<scree::Run> runs(const scree::ModelSpace& space, std::size_t count, std::uint64_t seed) {
  scree::Random random{seed, "design"};
  std::vector<scree::Run> out;
  for (const Eigen::VectorXd& at : scree::shared_design(space, count, 2, random)) {
    const auto values = observed(space.values(at), random, 1.0);
    Eigen::VectorXd compared(static_cast<Eigen::Index>(values.size()));
    for (std::size_t k = 0; k < values.size(); ++k) {
      compared[static_cast<Eigen::Index>(k)] = observables[k].logarithmic ? std::log(values[k]) : values[k];
    }
    out.push_back({at, compared});
  }
  return out;
}

struct Data {
  std::vector<double> truth;
  std::vector<scree::Measured> fitted, held_out;
};

/// \param shares of the causes' ranges that are in force, in the order of `causes()`; below 0 for null
inline Data data(const std::vector<double>& shares, std::uint64_t seed, double outside = 0.0,
                 std::size_t replicates = 6) {
  const scree::ModelSpace space{base(), causes()};
  scree::Random random{seed, "laboratory"};
  Eigen::VectorXd at = space.null();
  for (Eigen::Index k = 0; k < space.base(); ++k) {
    at[k] = random.uniform(0.2, 0.8);
  }
  for (std::size_t c = 0; c < shares.size(); ++c) {
    const Eigen::Index k = space.base() + static_cast<Eigen::Index>(c);
    at[k] = shares[c] < 0.0 ? at[k] : shares[c];
  }
  Data out{space.values(at), {}, {}};
  std::vector<scree::Measured> all;
  for (const Observable& o : observables) {
    all.push_back({.name = o.name, .logarithmic = o.logarithmic, .specimens = o.specimens});
  }
  for (std::size_t n = 0; n < replicates; ++n) {
    const auto values = observed(out.truth, random, 1.1, outside);
    for (std::size_t k = 0; k < values.size(); ++k) {
      all[k].replicates.push_back(values[k]);
    }
  }
  const auto middle = all.end() - static_cast<std::ptrdiff_t>(held_out);
  out.fitted.assign(all.begin(), middle);
  out.held_out.assign(middle, all.end());
  return out;
}

} // namespace toy
