#pragma once
/// \file
/// The shearing of a triaxial sample, its readings, and what is told from them.

#include "degree.hpp"
#include "scatter.hpp"
#include "triaxial_press.hpp"

#include "scree/measure/porosity.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace validation::drained {

/// True axial strains: of the whole test, from which on the state counts as critical, between two readings,
/// and on both sides of a reading that is smoothed. Ours.
constexpr double end_strain = 0.40, critical_from = 0.27, reading = 1e-3, window = 0.01;
constexpr std::size_t seeds = 3;

inline double friction_angle(double s1, double s3) {
  return std::asin((s1 - s3) / (s1 + s3)) / degree;
}

/// What one test gives, a reading for each step of strain; stresses are means over it.
struct Test {
  std::vector<double> strain, volume_strain, axial, lateral, void_ratio; // 1, 1, Pa, Pa, 1
  std::vector<double> contact_axial, contact_lateral; // over the walls', at the instant of the reading
  std::vector<double> core_solid;                     // share, of the critical part
  double inertial_number = 0.0, start_void_ratio = 0.0;
  double energy_error = 0.0; // of the balance, over the work at the boundary
  double step_strain = 0.0;  // of one time step
};

inline Test run_test(const PressSetup& setup, double consolidation_friction) {
  Press press{setup};
  press.consolidate(consolidation_friction);
  press.set_local_damping(0.0); // it would resist the strain itself
  Test test;
  test.start_void_ratio = press.void_ratio();
  test.step_strain = press.axial_rate() * press.time_step();
  const double work = press.boundary_work(), stored = press.stored(), lost = press.lost();
  scree::Vector before = press.impulse();
  double since = press.time();
  for (double next = reading; press.axial_strain() < end_strain;) {
    press.shear_step();
    if (press.axial_strain() < next) {
      continue;
    }
    next += reading;
    const scree::Vector now = press.impulse(), contact = press.contact_stress(), wall = press.stress();
    scree::Vector mean = (now - before) / (press.time() - since);
    for (int d = 0; d < 3; ++d) {
      mean[d] /= press.area(d);
    }
    before = now;
    since = press.time();
    test.strain.push_back(press.axial_strain());
    test.volume_strain.push_back(press.volume_strain());
    test.axial.push_back(mean[2]);
    test.lateral.push_back(0.5 * (mean[0] + mean[1]));
    test.void_ratio.push_back(press.void_ratio());
    test.contact_axial.push_back(contact[2] / wall[2]);
    test.contact_lateral.push_back((contact[0] + contact[1]) / (wall[0] + wall[1]));
    test.inertial_number = std::max(test.inertial_number, press.axial_rate() * setup.diameter *
                                                              std::sqrt(setup.density / mean.mean()));
    if (press.axial_strain() > critical_from && test.strain.size() % 13 == 0) {
      const scree::Vector top{press.size(0), press.size(1), press.size(2)};
      const scree::Vector margin = scree::Vector::Constant(1.5 * setup.diameter);
      test.core_solid.push_back(1.0 - scree::porosity(press.bodies(), {margin, top - margin}, 50'000));
    }
  }
  const double done = press.boundary_work() - work;
  test.energy_error = (press.stored() - stored + press.lost() - lost) / done - 1.0;
  return test;
}

inline double mean_between(const std::vector<double>& v, std::size_t first, std::size_t end) {
  double sum = 0.0;
  for (std::size_t k = first; k < end; ++k) {
    sum += v[k];
  }
  return sum / static_cast<double>(end - first);
}

/// Slope of the best line through y(x).
inline double slope(const std::vector<double>& x, const std::vector<double>& y, std::size_t first,
                    std::size_t end) {
  const double mx = mean_between(x, first, end), my = mean_between(y, first, end);
  double xx = 0.0, xy = 0.0;
  for (std::size_t k = first; k < end; ++k) {
    xx += (x[k] - mx) * (x[k] - mx);
    xy += (x[k] - mx) * (y[k] - my);
  }
  return xy / xx;
}

/// First reading of the critical part.
inline std::size_t critical(const Test& test) {
  return static_cast<std::size_t>(std::lower_bound(test.strain.begin(), test.strain.end(), critical_from) -
                                  test.strain.begin());
}
inline double critical_angle(const Test& t) {
  const std::size_t n = t.strain.size();
  return friction_angle(mean_between(t.axial, critical(t), n), mean_between(t.lateral, critical(t), n));
}
inline double critical_voids(const Test& t) {
  return mean_between(t.void_ratio, critical(t), t.strain.size());
}
inline double critical_dilation(const Test& t) {
  return -slope(t.strain, t.volume_strain, critical(t), t.strain.size());
}

inline double critical_solid(const Test& t) {
  return Mean{t.core_solid}.value;
}

/// Tests of the same kind of sample from several seeds.
struct Samples {
  std::string name;
  std::vector<Test> tests;

  [[nodiscard]] std::vector<double> each(double (*value)(const Test&)) const {
    std::vector<double> values;
    for (const Test& t : tests) {
      values.push_back(value(t));
    }
    return values;
  }
  /// The mean curves.
  [[nodiscard]] Test mean() const {
    Test sum = tests.front();
    for (auto curve : {&Test::strain, &Test::volume_strain, &Test::axial, &Test::lateral}) {
      for (std::size_t k = 0; k < sum.strain.size(); ++k) {
        double total = 0.0;
        for (const Test& t : tests) {
          total += (t.*curve).at(std::min(k, t.strain.size() - 1));
        }
        (sum.*curve)[k] = total / static_cast<double>(tests.size());
      }
    }
    return sum;
  }
};

/// The greatest of the smoothed friction angle, and how fast the sample dilates there.
struct Peak {
  double angle = 0.0, strain = 0.0, dilation = 0.0; ///< degrees, 1, -d eps_v / d eps_1
};

inline Peak peak_of(const Test& test) {
  const auto half = static_cast<std::size_t>(std::lround(window / reading));
  Peak peak;
  for (std::size_t k = half; k + half < test.strain.size(); ++k) {
    const std::size_t first = k - half, end = k + half + 1;
    const double angle =
        friction_angle(mean_between(test.axial, first, end), mean_between(test.lateral, first, end));
    if (angle > peak.angle) {
      peak = {angle, test.strain[k], -slope(test.strain, test.volume_strain, first, end)};
    }
  }
  return peak;
}

} // namespace validation::drained
