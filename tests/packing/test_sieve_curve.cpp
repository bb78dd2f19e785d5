#include "scree/packing/sieve_curve.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace scree;

namespace {

const std::vector<double> openings{9.5e-3, 13.2e-3, 19.0e-3, 26.5e-3, 37.5e-3};
const std::vector<double> fractions{0.0, 0.2, 0.2, 0.7, 1.0}; // nothing between the second and third sieve

} // namespace

TEST_CASE("passing and quantile are each other's inverse") {
  for (const auto basis : {SieveBasis::number, SieveBasis::mass}) {
    const SieveCurve curve{openings, fractions, basis};
    for (int i = 0; i <= 1000; ++i) {
      const double u = i / 1000.0;
      CHECK(std::abs(curve.passing(curve.quantile(u)) - u) < 1e-12);
    }
    for (const double size : {10e-3, 12e-3, 20e-3, 26.5e-3, 30e-3}) {
      CHECK(curve.quantile(curve.passing(size)) == test::about(size, 1e-12));
    }
  }
}

TEST_CASE("the curve is linear between sieves and meets them") {
  const SieveCurve curve{openings, fractions, SieveBasis::mass};
  for (std::size_t i = 0; i < openings.size(); ++i) {
    CHECK(curve.passing(openings[i]) == fractions[i]);
  }
  CHECK(curve.passing(0.5 * (19.0e-3 + 26.5e-3)) == test::about(0.45, 1e-14));
  CHECK(curve.passing(16e-3) == test::about(0.2, 1e-14));
  CHECK(curve.passing(1e-3) == 0.0);
  CHECK(curve.passing(1.0) == 1.0);
  CHECK(curve.quantile(0.0) == 9.5e-3);
  CHECK(curve.quantile(1.0) == 37.5e-3);
  // A gap in the curve is stepped over: no grain comes from a class that holds none.
  CHECK(curve.quantile(0.2) == 19.0e-3);
  CHECK(curve.quantile(0.2 - 1e-9) < 13.2e-3);
}

TEST_CASE("leading and trailing classes without material are not drawn from") {
  const SieveCurve curve{{0.01, 0.02, 0.03, 0.04}, {0.0, 0.0, 1.0, 1.0}, SieveBasis::mass};
  CHECK(curve.quantile(0.0) == 0.02);
  CHECK(curve.quantile(1.0) == 0.03);
  CHECK(curve.number_quantile(0.0) == test::about(0.02, 1e-15));
  CHECK(curve.number_quantile(1.0) == test::about(0.03, 1e-15));
}

TEST_CASE("a curve by number draws its own quantiles") {
  const SieveCurve curve{openings, fractions, SieveBasis::number};
  for (const double u : {0.0, 0.1, 0.2, 0.5, 0.9, 1.0}) {
    CHECK(curve.number_quantile(u) == curve.quantile(u));
  }
}

TEST_CASE("sizes drawn by number have the mass fractions of a curve by mass") {
  // Sum the cubes of evenly spaced number quantiles up to each sieve: the midpoint rule for the mass.
  const SieveCurve curve{openings, fractions, SieveBasis::mass};
  constexpr int count = 200000;
  std::vector<double> mass(openings.size() - 1, 0.0);
  double total = 0.0;
  for (int i = 0; i < count; ++i) {
    const double size = curve.number_quantile((i + 0.5) / count);
    mass[curve.class_of(size)] += size * size * size;
    total += size * size * size;
  }
  for (std::size_t i = 0; i < mass.size(); ++i) {
    CHECK(std::abs(mass[i] / total - (fractions[i + 1] - fractions[i])) < 3e-5);
  }
  CHECK(total / count == test::about(curve.mean_cubed_size(), 3e-5));
}

TEST_CASE("mean cubed size of one class in closed form") {
  const double a = 0.01, b = 0.03;
  const SieveCurve by_number{{a, b}, {0.0, 1.0}, SieveBasis::number};
  CHECK(by_number.mean_cubed_size() ==
        test::about((std::pow(b, 4) - std::pow(a, 4)) / (4.0 * (b - a)), 1e-14));
  const SieveCurve by_mass{{a, b}, {0.0, 1.0}, SieveBasis::mass};
  CHECK(by_mass.mean_cubed_size() == test::about((b - a) / (0.5 * (1.0 / (a * a) - 1.0 / (b * b))), 1e-14));
}

TEST_CASE("classes of sizes on and beyond the sieves") {
  const SieveCurve curve{openings, fractions, SieveBasis::number};
  CHECK(curve.class_of(1e-3) == 0);
  CHECK(curve.class_of(9.5e-3) == 0);
  CHECK(curve.class_of(13.2e-3) == 1);
  CHECK(curve.class_of(std::nextafter(13.2e-3, 0.0)) == 0);
  CHECK(curve.class_of(37.5e-3) == 3);
  CHECK(curve.class_of(1.0) == 3);
  const SieveCurve two{{0.01, 0.02}, {0.0, 1.0}, SieveBasis::number};
  CHECK(two.class_of(0.015) == 0);
}

TEST_CASE("bad curves are refused with the sieve") {
  const auto complaint = [](std::vector<double> o, std::vector<double> p) -> std::string {
    try {
      const SieveCurve curve{std::move(o), std::move(p), SieveBasis::number};
    } catch (const Error& e) {
      return e.what();
    }
    return "accepted";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(complaint({0.01, 0.02}, {0.0, 1.0}) == "accepted");
  CHECK(complaint({0.01}, {1.0}).find("at least 2") != std::string::npos);
  CHECK(complaint({0.01, 0.02, 0.03}, {0.0, 1.0}).find("3 openings and 2 fractions") != std::string::npos);
  CHECK(complaint({0.0, 0.02}, {0.0, 1.0}).find("sieve 1: opening = 0 m") != std::string::npos);
  CHECK(complaint({0.01, nan}, {0.0, 1.0}).find("sieve 2: opening") != std::string::npos);
  CHECK(complaint({0.02, 0.02}, {0.0, 1.0}).find("sieve 2: opening 0.02 m is not above") !=
        std::string::npos);
  CHECK(complaint({0.01, 0.02}, {0.0, 1.1}).find("sieve 2: fraction passing = 1.1") != std::string::npos);
  CHECK(complaint({0.01, 0.02, 0.03}, {0.0, nan, 1.0}).find("sieve 2: fraction") != std::string::npos);
  CHECK(complaint({0.01, 0.02, 0.03, 0.04}, {0.0, 0.5, 0.4, 1.0})
            .find("sieve 3: fraction passing 0.4 is below") != std::string::npos);
  CHECK(complaint({0.01, 0.02}, {0.1, 1.0}).find("runs from 0.1 to 1") != std::string::npos);
  CHECK(complaint({0.01, 0.02}, {0.0, 0.9}).find("runs from 0 to 0.9") != std::string::npos);
  const SieveCurve curve = default_sieve_curve();
  CHECK_THROWS_AS((void)curve.quantile(-0.1), Error);
  CHECK_THROWS_AS((void)curve.number_quantile(1.1), Error);
  CHECK_THROWS_AS((void)curve.quantile(nan), Error);
}
