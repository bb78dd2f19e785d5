#include "scree/packing/assembly.hpp"
#include "scree/packing/size_histogram.hpp"
#include "support/relative_error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace scree;

namespace {

std::vector<ShapeFraction> two_shapes(SieveBasis basis) {
  return {
      {make_clump("ball", single_sphere()), 0.3, SieveCurve{{0.01, 0.02, 0.04}, {0.0, 0.4, 1.0}, basis}},
      {make_clump("rod", aligned_spheres()), 0.7, SieveCurve{{0.01, 0.015, 0.03}, {0.0, 0.5, 1.0}, basis}}};
}

double solid_volume(const Assembly& assembly, const std::vector<DrawnClump>& drawn) {
  double sum = 0.0;
  for (const DrawnClump& d : drawn) {
    sum += assembly.shapes()[d.shape].shape.union_volume * std::pow(d.scale, 3);
  }
  return sum;
}

} // namespace

TEST_CASE("numbers of grains by shape and class follow the request to within two") {
  const Assembly assembly{two_shapes(SieveBasis::number)};
  for (const std::size_t count : {10U, 1000U, 30000U}) {
    Random random{21};
    const auto drawn = assembly.draw(count, random);
    REQUIRE(drawn.size() == count);
    for (const SizeHistogram& h : size_histograms(assembly, drawn)) {
      const double n = static_cast<double>(count);
      CAPTURE(n);
      CHECK(std::abs(h.generated_fraction - h.target_fraction) * n < 2.0);
      for (std::size_t i = 0; i < h.target.size(); ++i) {
        const double expected = h.target_fraction * h.target[i] * n;
        const double found = h.generated_fraction * h.generated[i] * n;
        CHECK(std::abs(found - expected) < 2.0 + 1e-6);
      }
    }
  }
}

TEST_CASE("mass fractions of a curve by mass follow the request as the count grows") {
  const Assembly assembly{two_shapes(SieveBasis::mass)};
  for (const std::size_t count : {1000U, 30000U}) {
    Random random{22};
    const auto drawn = assembly.draw(count, random);
    const auto histograms = size_histograms(assembly, drawn);
    for (std::size_t k = 0; k < histograms.size(); ++k) {
      const SizeHistogram& h = histograms[k];
      CHECK(h.basis == SieveBasis::mass);
      // A stratified sum of a monotone function errs by its range, and at each end of a class or shape by one
      // more value: three of the largest grains for the class, as many for the whole it is divided by.
      const double number = h.generated_fraction * static_cast<double>(count);
      const double total = number * assembly.shapes()[k].sizes.mean_cubed_size();
      const double bound = 6.0 * std::pow(h.openings.back(), 3) / total;
      for (std::size_t i = 0; i < h.target.size(); ++i) {
        CHECK(std::abs(h.generated[i] - h.target[i]) < bound);
      }
      CHECK(bound < 250.0 / static_cast<double>(count)); // the bound itself means something
    }
  }
}

TEST_CASE("sizes within a class are spread as the curve says") {
  // Kolmogorov-Smirnov distance between the drawn sizes of a shape and its curve. Stratified over n grains,
  // each shape's empirical distribution is within two grains of the target.
  const Assembly assembly{two_shapes(SieveBasis::number)};
  Random random{23};
  const auto drawn = assembly.draw(5000, random);
  for (std::size_t shape = 0; shape < 2; ++shape) {
    std::vector<double> sizes;
    for (const DrawnClump& d : drawn) {
      if (d.shape == shape) {
        sizes.push_back(assembly.material_size(d));
      }
    }
    std::sort(sizes.begin(), sizes.end());
    const double n = static_cast<double>(sizes.size());
    double distance = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const double passing = assembly.shapes()[shape].sizes.passing(sizes[i]);
      distance = std::max(distance, std::abs(passing - (static_cast<double>(i) + 0.5) / n));
    }
    CHECK(distance * n < 4.0);
  }
}

TEST_CASE("the order of the draw is random") {
  // Neighbours in the list must not be alike: the correlation of sizes one apart is zero to within 4 standard
  // errors.
  const Assembly assembly{two_shapes(SieveBasis::number)};
  Random random{24};
  const auto drawn = assembly.draw(10000, random);
  double mean = 0.0, squares = 0.0, products = 0.0;
  for (const DrawnClump& d : drawn) {
    mean += assembly.material_size(d) / 10000.0;
  }
  for (std::size_t i = 0; i + 1 < drawn.size(); ++i) {
    const double a = assembly.material_size(drawn[i]) - mean;
    squares += a * a;
    products += a * (assembly.material_size(drawn[i + 1]) - mean);
  }
  CHECK(std::abs(products / squares) < 4.0 / std::sqrt(10000.0));
}

TEST_CASE("the same seed draws the same grains, another seed others") {
  const Assembly assembly{default_rock()};
  const auto draw = [&](std::uint64_t seed) {
    Random random{seed, "grains"};
    return assembly.draw(500, random);
  };
  const auto a = draw(1), b = draw(1), c = draw(2);
  std::size_t same_as_b = 0, same_as_c = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    same_as_b += a[i].shape == b[i].shape && a[i].scale == b[i].scale;
    same_as_c += a[i].shape == c[i].shape && a[i].scale == c[i].scale;
  }
  CHECK(same_as_b == a.size());
  CHECK(same_as_c < 5);
}

TEST_CASE("a requested solid volume is met") {
  for (const auto basis : {SieveBasis::number, SieveBasis::mass}) {
    for (const double factor : {1.0, 1.7}) {
      const Assembly assembly{two_shapes(basis), factor};
      Random random{25};
      const double wanted = 0.03;
      const auto drawn = assembly.draw_volume(wanted, random);
      double largest = 0.0;
      for (const DrawnClump& d : drawn) {
        largest = std::max(largest, assembly.shapes()[d.shape].shape.union_volume * std::pow(d.scale, 3));
      }
      CHECK(std::abs(solid_volume(assembly, drawn) - wanted) < 4.0 * largest);
      CHECK(largest < 0.02 * wanted);
    }
  }
  const Assembly assembly{default_rock()};
  Random random{26};
  CHECK(assembly.draw_volume(1e-12, random).size() == 1);
  CHECK_THROWS_AS((void)assembly.draw_volume(0.0, random), Error);
  CHECK_THROWS_AS((void)assembly.draw_volume(1e9, random), Error);
}

TEST_CASE("a size factor enlarges every grain alike") {
  const Assembly material{default_rock()};
  const Assembly coarse{default_rock(), 2.5};
  Random one{27}, other{27};
  const auto a = material.draw(200, one);
  const auto b = coarse.draw(200, other);
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].shape == b[i].shape);
    CHECK(b[i].scale == test::about(2.5 * a[i].scale, 1e-14));
    CHECK(coarse.material_size(b[i]) == test::about(material.material_size(a[i]), 1e-14));
  }
  CHECK(coarse.mean_volume() == test::about(std::pow(2.5, 3) * material.mean_volume(), 1e-13));
}

TEST_CASE("a drawn grain passes the sieve it was drawn for") {
  const Assembly assembly{default_rock()};
  const auto clumps = assembly.clumps();
  Random random{28};
  for (const DrawnClump& d : assembly.draw(200, random)) {
    const double size = sieve_size(scaled(clumps[d.shape], d.scale));
    CHECK(size == test::about(assembly.material_size(d), 1e-12));
    CHECK(size >= 9.5e-3 * (1.0 - 1e-12));
    CHECK(size <= 37.5e-3 * (1.0 + 1e-12));
  }
}

TEST_CASE("a shape of fraction zero is not drawn, and its histogram is empty") {
  auto shapes = two_shapes(SieveBasis::number);
  shapes[0].fraction = 1.0;
  shapes[1].fraction = 0.0;
  const Assembly assembly{shapes};
  Random random{29};
  const auto histograms = size_histograms(assembly, assembly.draw(1000, random));
  CHECK(histograms[1].target_fraction == 0.0);
  CHECK(histograms[1].generated_fraction == 0.0);
  CHECK(histograms[1].generated == std::vector<double>{0.0, 0.0});
  CHECK(histograms[0].generated_fraction == test::about(1.0, 1e-12));
}

TEST_CASE("nothing drawn gives empty histograms") {
  const Assembly assembly{default_rock()};
  for (const SizeHistogram& h : size_histograms(assembly, {})) {
    CHECK(h.generated_fraction == 0.0);
    CHECK(h.generated == std::vector<double>(4, 0.0));
  }
}

TEST_CASE("fractions that are no distribution are refused") {
  auto shapes = two_shapes(SieveBasis::number);
  shapes[1].fraction = 0.6;
  CHECK_THROWS_AS(Assembly{shapes}, Error);
  shapes[1].fraction = -0.1;
  CHECK_THROWS_AS(Assembly{shapes}, Error);
  CHECK_THROWS_AS(Assembly{std::vector<ShapeFraction>{}}, Error);
  CHECK_THROWS_AS((Assembly{two_shapes(SieveBasis::number), 0.0}), Error);
}
