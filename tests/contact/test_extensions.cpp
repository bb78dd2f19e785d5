/// \file
/// The extensions of the linear law, each by its formula and by the energy that it takes and gives back.

#include "support/driven_contact.hpp"
#include "support/relative_error.hpp"

#include "scree/contact/adhesion.hpp"
#include "scree/contact/attrition.hpp"
#include "scree/contact/linear_spring.hpp"
#include "scree/contact/normal_exponent.hpp"
#include "scree/contact/normal_hysteresis.hpp"
#include "scree/contact/rate_friction.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace scree;
using test::DrivenContact;
using test::relative_error;

namespace {

constexpr double radius = 0.01, reduced_radius = 0.005, stiffness = 1e5, friction = 0.4, dt = 1e-6;

Material elastic() {
  return {
      .normal_stiffness = stiffness, .shear_stiffness = stiffness, .friction = friction, .restitution = 1.0};
}

/// A contact that is pressed to some overlap along z, and slides along x, as slowly as one likes.
template <class Law>
class Pressed {
public:
  explicit Pressed(const Law& law) : contact{law, elastic(), radius, radius} {
    contact.place(at(0.0), Vector::Zero());
  }
  /// In `steps` even steps.
  void press(double overlap, int steps = 1000) {
    const double from = overlap_;
    for (int k = 1; k <= steps; ++k) {
      overlap_ = from + (overlap - from) * k / steps;
      contact.move(at(overlap_), Vector::Zero(), Vector::Zero(), Vector::Zero(), dt);
    }
  }
  [[nodiscard]] double force() const { return contact.force.normal; }
  /// J, put in and neither held nor lost.
  [[nodiscard]] double missing() const {
    return contact.work_put_in - contact.friction - contact.viscous - contact.elastic_energy();
  }

  DrivenContact<Law> contact;

private:
  static Vector at(double overlap) { return {0.0, 0.0, 2.0 * radius - overlap}; }
  double overlap_ = 0.0;
};

/// A law's answer to a slip at one speed [m/s] under one overlap [m], step after step.
template <class Law>
class Sliding {
public:
  explicit Sliding(const Law& law) : law_{law} {
    k_.normal = {0.0, 0.0, 1.0};
    k_.reduced_radius = reduced_radius;
    k_.reduced_mass = k_.root_mass = 1.0;
    k_.dt = dt;
  }
  ContactForce<double> step(double speed, double overlap) {
    k_.velocity = {speed, 0.0, 0.0};
    k_.overlap = overlap;
    return law_.evaluate(pair_, k_, history_);
  }

private:
  Law law_;
  PairMaterial<double> pair_ = mix(elastic(), elastic(), Stiffness::of_contact);
  Kinematics<double> k_{};
  std::array<double, static_cast<std::size_t>(Law::history_size)> history_{};
};

} // namespace

TEST_CASE("adhesion pulls by 2 pi w R* while there is overlap, and keeps no energy for itself") {
  const double w = 5.0, pull = 2.0 * std::numbers::pi * w * reduced_radius;
  Pressed<LinearSpring<Adhesion>> pressed{LinearSpring<Adhesion>{Adhesion{w}}};
  pressed.press(1e-6);
  CHECK(relative_error(pressed.force(), stiffness * 1e-6 - pull) < 1e-9);
  pressed.press(1e-4);
  CHECK(relative_error(pressed.force(), stiffness * 1e-4 - pull) < 1e-9);
  // The first step begins without contact, and its mean force misses half of the pull.
  CHECK(std::abs(pressed.missing()) < 1e-3 * stiffness * 1e-8);
}

TEST_CASE("a normal exponent makes Hertz's curve of the linear one, and gives its work back") {
  const double u0 = 0.01 * reduced_radius;
  for (const double n : {1.0, 1.25, 1.5}) {
    Pressed<LinearSpring<NormalExponent>> pressed{LinearSpring<NormalExponent>{NormalExponent{n}}};
    for (const double share : {0.1, 1.0, 4.0}) {
      pressed.press(share * u0, 20000);
      CHECK(relative_error(pressed.force(), stiffness * u0 * std::pow(share, n)) < 1e-9);
      const double energy = stiffness * u0 * u0 * std::pow(share, n + 1.0) / (n + 1.0);
      CHECK(relative_error(pressed.contact.elastic_energy(), energy) < 1e-9);
      CHECK(std::abs(pressed.missing()) < 1e-5 * energy);
    }
  }
  // At the largest overlap of an impact: k u0^(1-n) U^(n+1) / (n+1) = m v^2 / 2.
  const LinearSpring<NormalExponent> law{NormalExponent{1.5}};
  const auto pair = mix(elastic(), elastic(), Stiffness::of_contact);
  const double overlap = 1e-3,
               speed = std::sqrt(2.0 / 0.01 * stiffness * std::pow(u0, -0.5) * std::pow(overlap, 2.5) / 2.5);
  CHECK(relative_error(law.stiffness(pair, reduced_radius, 0.01, speed).normal,
                       1.5 * stiffness * std::sqrt(overlap / u0)) < 1e-9);
  CHECK(law.stiffness(pair, reduced_radius, 0.01, 1e-9).normal == stiffness);
}

TEST_CASE("hysteresis: loaded along k_n, unloaded and loaded again along r k_n, and 1/r comes back") {
  const double r = 2.5, most = 1e-4, left = most * (1.0 - 1.0 / r);
  Pressed<LinearSpring<NormalHysteresis>> pressed{LinearSpring<NormalHysteresis>{NormalHysteresis{r}}};
  pressed.press(most);
  CHECK(relative_error(pressed.force(), stiffness * most) < 1e-9);
  const double put_in = 0.5 * stiffness * most * most;
  CHECK(relative_error(pressed.contact.work_put_in, put_in) < 1e-6);
  CHECK(relative_error(pressed.contact.elastic_energy(), put_in / r) < 1e-6);
  CHECK(relative_error(pressed.contact.friction, put_in * (1.0 - 1.0 / r)) < 1e-6);
  pressed.press(0.5 * (most + left));
  CHECK(relative_error(pressed.force(), r * stiffness * 0.5 * (most - left)) < 1e-9);
  pressed.press(0.9 * left);
  CHECK(pressed.force() == 0.0);
  CHECK(std::abs(pressed.missing()) < 1e-5 * put_in);
  pressed.press(0.9 * most);
  CHECK(relative_error(pressed.force(), r * stiffness * (0.9 * most - left)) < 1e-9);
  pressed.press(1.5 * most, 5000);
  CHECK(relative_error(pressed.force(), stiffness * 1.5 * most) < 1e-9);
  CHECK(std::abs(pressed.missing()) < 1e-5 * put_in);
  const auto pair = mix(elastic(), elastic(), Stiffness::of_contact);
  const LinearSpring<NormalHysteresis> law{NormalHysteresis{r}};
  CHECK(law.stiffness(pair, reduced_radius, 0.01, 1.0).normal == r * stiffness);
}

TEST_CASE("friction that changes with speed is mu (1 + b v), and never below 0") {
  for (const double slope : {-0.5, 0.0, 2.0}) {
    for (const double speed : {0.01, 0.3, 3.0}) {
      Sliding<LinearSpring<RateFriction>> sliding{LinearSpring<RateFriction>{RateFriction{slope}}};
      ContactForce<double> f;
      for (int k = 0; k < 10000; ++k) {
        f = sliding.step(speed, 1e-5);
      }
      const double expected = std::max(0.0, friction * (1.0 + slope * speed)) * stiffness * 1e-5;
      CHECK(std::abs(f.tangential.x + expected) < 1e-9);
    }
  }
}

TEST_CASE("friction wears off with the work of sliding") {
  const double rate = 200.0, speed = 0.5, overlap = 1e-4, load = stiffness * overlap;
  Sliding<LinearSpring<Attrition>> sliding{LinearSpring<Attrition>{Attrition{rate}}};
  double work = 0.0, way = 0.0;
  ContactForce<double> f;
  for (int k = 0; k < 200000; ++k) {
    f = sliding.step(speed, overlap);
    work += f.frictional_work;
    way += speed * dt;
  }
  // dW = mu F / (1 + a W) ds, so W + a W^2 / 2 = mu F s, but for what the spring takes up at first.
  CHECK(relative_error(work + 0.5 * rate * work * work, friction * load * way) < 2e-3);
  CHECK(relative_error(-f.tangential.x, friction / (1.0 + rate * work) * load) < 1e-4);
  CHECK(-f.tangential.x < 0.5 * friction * load);
}

TEST_CASE("an extension out of its range, or on another law, is refused by name") {
  const auto pair = mix(elastic(), elastic(), Stiffness::of_contact);
  const PairMaterial<double> hertzian{};
  const auto refused = [](const auto& extension, const PairMaterial<double>& with, const char* part) {
    CHECK_THROWS_WITH_AS(extension.check(with, "'rock' and 'rock'"), doctest::Contains(part), Error);
  };
  refused(Adhesion{-1.0}, pair, "Adhesion::work = -1 J/m2 is outside [0, ");
  refused(NormalExponent{0.9}, pair, "NormalExponent::exponent = 0.9 is outside [1, 2]");
  refused(NormalExponent{1.5, 0.0}, pair, "NormalExponent::reference = 0");
  refused(NormalExponent{1.5}, hertzian, "'rock' and 'rock': NormalExponent extends a linear law");
  refused(NormalHysteresis{0.5}, pair, "NormalHysteresis::ratio = 0.5 is outside [1, 1000]");
  refused(NormalHysteresis{2.0}, hertzian, "NormalHysteresis extends a linear law");
  refused(RateFriction{std::nan("")}, pair, "RateFriction::slope = nan");
  refused(Attrition{-2.0}, pair, "Attrition::rate = -2 1/J is outside [0, ");
}
