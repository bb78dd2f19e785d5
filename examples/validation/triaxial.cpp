/// \file
/// Drained triaxial compression of spheres with friction, dense and loose: peak, dilation and critical state,
/// beside theory, another code and sand.

#include "cases.hpp"
#include "number_rows.hpp"
#include "reference_curve.hpp"
#include "triaxial_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace validation {

namespace {

using namespace drained;

constexpr double level = 0.99; // of Student's t

/// Friction angles in triaxial compression that a ratio of shear stress to mean stress in simple shear stands
/// for: by Matsuoka and Nakai (1974), with the geometric mean of the others as the intermediate stress that
/// their surface gives to plane strain, and by Mohr and Coulomb, with the arithmetic mean.
struct Range {
  double low, high; // degrees
};

Range triaxial_angle(double stress_ratio) {
  double s = stress_ratio; // (s1 - s3) / (s1 + s3)
  for (int k = 0; k < 50; ++k) {
    s = stress_ratio * (2.0 + std::sqrt(1.0 - s * s)) / 3.0;
  }
  const double s1 = 1.0 + s, s3 = 1.0 - s, s2 = std::sqrt(s1 * s3);
  const double k = (s1 + s2 + s3) * (s1 * s2 + s2 * s3 + s3 * s1) / (s1 * s2 * s3);
  return {std::atan(std::sqrt((k - 9.0) / 8.0)) / degree, std::asin(stress_ratio) / degree};
}

/// Degrees, from the critical angle and the dilation rate by Rowe (1962): the stress ratio is that of the
/// critical state times 1 plus the rate.
double rowe_angle(double critical, double dilation) {
  const double s = std::sin(critical * degree), ratio = (1.0 + s) / (1.0 - s) * (1.0 + dilation);
  return friction_angle(ratio, 1.0);
}

/// A triaxial test of sand.
struct SandTest {
  std::vector<double> strain, volume_strain, ratio; // %, %, q/p
};

/// From a file of the Karlsruhe fine sand data base, whose columns are eps1, epsv, eps3, epsq, e, q, p, q/p.
SandTest read_sand(const std::filesystem::path& file) {
  std::ifstream in{file};
  SandTest test;
  for (const auto& row : rows_of(in, 8)) {
    test.strain.push_back(row[0]);
    test.volume_strain.push_back(row[1]);
    test.ratio.push_back(row[7]);
  }
  if (test.strain.empty()) {
    throw scree::Error(scree::message(file.string(), ": holds no readings"));
  }
  return test;
}

/// Readings at least 1.5 % of strain apart.
Series thinned(const std::string& label, const std::vector<double>& x, const std::vector<double>& y) {
  Series out{label, Origin::experiment, {}, {}};
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (out.x.empty() || x[k] >= out.x.back() + 1.5) {
      out.x.push_back(x[k]);
      out.y.push_back(y[k]);
    }
  }
  return out;
}

double most(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

/// What each kind of sample must do by itself.
void add_balances(Outcome& out, const std::string& name, const PressSetup& setup, const Samples& samples) {
  double inertial = 0.0, energy = 0.0;
  std::vector<double> axial, lateral;
  for (const Test& t : samples.tests) {
    inertial = std::max(inertial, t.inertial_number);
    energy = std::abs(t.energy_error) > std::abs(energy) ? t.energy_error : energy;
    axial.push_back(Mean{t.contact_axial}.value);
    lateral.push_back(Mean{t.contact_lateral}.value);
  }
  out.add(name, "largest inertial number", "1", 0.0, {Origin::theory, "quasi-static (GDR MiDi 2004)"},
          inertial, {1e-3, false, "quasi-static below 1/1000 (GDR MiDi 2004)"});
  out.add(name, "energy stored and lost over the work at the walls, minus 1", "1", 0.0,
          {Origin::theory, "conservation of energy"}, energy,
          {5e-3, false,
           "first order of the time step in the contact: its own period has 25 steps; 1/200 (ours)"});
  const Tolerance lag{
      samples.tests.front().step_strain * setup.stiffness_ratio, true,
      "forces between spheres are told one time step after those on the walls: strain of a step "
      "over that of a contact"};
  const Source love{Origin::theory, "Love-Weber stress of all contacts equals that on the walls"};
  out.add(name, "axial stress of the contacts over that of the walls", "1", 1.0, love, Mean{axial}.value,
          lag);
  out.add(name, "lateral stress of the contacts over that of the walls", "1", 1.0, love, Mean{lateral}.value,
          lag);
}

void add_equal(Outcome& out, const std::string& name, const std::string& quantity, const std::string& unit,
               const std::vector<double>& dense, const std::vector<double>& loose) {
  const Mean d{dense}, l{loose};
  out.add(name, quantity + ", dense less loose", unit, 0.0, {Origin::theory, "one critical state"},
          d.value - l.value,
          {margin_of_difference(d, l, level), false,
           "Student's t at 99 % times the standard error of the difference, over three samples of each"});
}

Outcome findings(const Inputs& inputs, const PressSetup& setup, const Samples& dense, const Samples& loose) {
  const std::string name = "triaxial compression of spheres";
  Outcome out;
  for (const Samples* s : {&dense, &loose}) {
    add_balances(out, name + ", " + s->name, setup, *s);
  }
  const auto d_angle = dense.each(critical_angle), l_angle = loose.each(critical_angle);
  add_equal(out, name, "critical friction angle", "degrees", d_angle, l_angle);
  add_equal(out, name, "critical void ratio", "1", dense.each(critical_voids), loose.each(critical_voids));
  for (const Samples* s : {&dense, &loose}) {
    const Mean rate{s->each(critical_dilation)};
    const Mean other{(s == &dense ? loose : dense).each(critical_dilation)};
    out.add(name + ", " + s->name, "dilation rate at the end", "1", 0.0, {Origin::theory, "critical state"},
            rate.value,
            {margin_of_difference(rate, other, level) / std::sqrt(2.0), false,
             "Student's t at 99 % times the standard error of the mean of three samples, from all six"});
  }

  const auto of_all = [&](double (*value)(const Test&)) {
    auto values = dense.each(value);
    const auto others = loose.each(value);
    values.insert(values.end(), others.begin(), others.end());
    return Mean{values};
  };
  const Mean critical_of_all = of_all(critical_angle), core = of_all(critical_solid);
  const double crit = critical_of_all.value;
  const Range range = triaxial_angle(0.382);
  out.add(name, "critical friction angle of all samples", "degrees", 0.5 * (range.low + range.high),
          {Origin::code, "Chialvo, Sun & Sundaresan (2012), mu 0.5: tau / p 0.382 in simple shear"}, crit,
          {0.5 * (range.high - range.low) + critical_of_all.margin(level), false,
           "from simple shear to triaxial by Matsuoka & Nakai or by Mohr & Coulomb, and Student's t at 99 % "
           "times the standard error"});
  out.add(
      name, "critical solid fraction in the core of all samples", "1", 0.587,
      {Origin::code, "Chialvo, Sun & Sundaresan (2012), equal spheres, mu 0.5, jamming in simple shear"},
      core.value,
      {3.0 / setup.stiffness_ratio + 0.005 + 2.0 * core.error, false,
       "overlap under the pressure, 3 p d / k; 0.005 for the spread of sizes (ours); two standard errors"});

  const Test d_mean = dense.mean(), l_mean = loose.mean();
  const Peak d_peak = peak_of(d_mean), l_peak = peak_of(l_mean);
  const auto over_bolton = [](const Test& t) {
    const Peak peak = peak_of(t);
    return peak.angle - critical_angle(t) - 10.0 * peak.dilation;
  };
  for (const Samples* samples : {&dense, &loose}) {
    const Mean over{samples->each(over_bolton)};
    out.add(name + ", " + samples->name, "peak less critical friction angle, less Bolton's", "degrees", 0.0,
            {Origin::experiment, "Bolton (1986), sands: 3 I_R degrees at a dilation rate of 0.3 I_R"},
            over.value,
            {2.0 + over.margin(level), false,
             "scatter of Bolton's tests, some 2 degrees, and Student's t at 99 % times the standard error"});
  }
  out.notes.push_back(
      fmt::format("{}: the dense samples have {:.1f} degrees above the critical angle at a dilation rate of "
                  "{:.2f}. Bolton's relation, measured on sands, gives {:.1f}; Rowe's (1962) with the "
                  "critical angle {:.1f}.",
                  name, d_peak.angle - crit, d_peak.dilation, 10.0 * d_peak.dilation,
                  rowe_angle(crit, d_peak.dilation) - crit));
  out.notes.push_back(fmt::format("{}: the loose samples have {:.1f} degrees at a dilation rate of {:.2f}.",
                                  name, l_peak.angle - crit, l_peak.dilation));

  Chart ratio{"triaxial_ratio", name, "axial strain, %", "q / p", {}, {}};
  Chart volume{"triaxial_volume", name, "axial strain, %", "volume strain, %, contraction above 0", {}, {}};
  for (const auto& [test, label] : {std::pair{&d_mean, "dense"}, std::pair{&l_mean, "loose"}}) {
    Series q{label, Origin::code, {}, {}}, v = q;
    for (std::size_t k = 0; k < test->strain.size(); k += 4) {
      const double s1 = test->axial[k], s3 = test->lateral[k];
      q.x.push_back(100.0 * (1.0 - std::exp(-test->strain[k])));
      q.y.push_back(3.0 * (s1 - s3) / (s1 + 2.0 * s3));
      v.y.push_back(100.0 * (1.0 - std::exp(-test->volume_strain[k])));
    }
    v.x = q.x;
    ratio.simulated.push_back(q);
    volume.simulated.push_back(v);
  }
  if (inputs.reference.empty()) {
    out.notes.push_back(name + ": sand needs the reference data");
  } else {
    const SandTest loose_sand = read_sand(inputs.file("kfsdb_sand/TMD/TMD2.dat"));
    const SandTest dense_sand = read_sand(inputs.file("kfsdb_sand/TMD/TMD22.dat"));
    for (const auto& [test, label] : {std::pair{&dense_sand, "Karlsruhe fine sand, e 0.735, 100 kPa"},
                                      std::pair{&loose_sand, "the same, e 0.975"}}) {
      ratio.references.push_back(thinned(label, test->strain, test->ratio));
      volume.references.push_back(thinned(label, test->strain, test->volume_strain));
    }
    const auto sign = [](double value) { return value > 0.0 ? 1.0 : -1.0; };
    const Source sand{Origin::experiment,
                      "Karlsruhe fine sand, TMD 2 and 22 (Wichtmann & Triantafyllidis 2016)"};
    const Tolerance direction{0.5, false, "the sign: spheres are weaker than sand"};
    out.add(name, "sign of the peak q/p of dense less loose", "1",
            sign(most(dense_sand.ratio) - most(loose_sand.ratio)), sand, sign(d_peak.angle - l_peak.angle),
            direction);
    out.add(name, "sign of the volume strain at the end, dense", "1", sign(dense_sand.volume_strain.back()),
            sand, sign(d_mean.volume_strain.back()), direction);
    out.add(name, "sign of the greatest contraction of loose less dense", "1",
            sign(most(loose_sand.volume_strain) - most(dense_sand.volume_strain)), sand,
            sign(most(l_mean.volume_strain) - most(d_mean.volume_strain)), direction);
  }
  out.draw(ratio);
  out.draw(volume);
  out.notes.push_back(fmt::format(
      "{}: {} seeds of {} spheres, k_n / (p d) {:g}, void ratio {:.3f} (dense, no friction while "
      "consolidated) "
      "and {:.3f} (loose) at the start; peak {:.1f} degrees at {:.1f} % and dilation rate {:.2f} (dense); "
      "all "
      "inputs are ours. The void ratios are those between the walls, which are looser than the core.",
      name, seeds, setup.spheres, setup.stiffness_ratio, dense.tests.front().start_void_ratio,
      loose.tests.front().start_void_ratio, d_peak.angle, 100.0 * d_peak.strain, d_peak.dilation));
  return out;
}

} // namespace

Outcome triaxial(const Inputs& inputs) {
  PressSetup setup;
  setup.threads = inputs.threads;
  setup.spheres = inputs.full ? 8000 : setup.spheres;
  Samples dense{"dense", {}}, loose{"loose", {}};
  for (setup.seed = 1; setup.seed <= seeds; ++setup.seed) {
    dense.tests.push_back(run_test(setup, 0.0));
    loose.tests.push_back(run_test(setup, setup.friction));
  }
  return findings(inputs, setup, dense, loose);
}

} // namespace validation
