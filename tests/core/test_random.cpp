#include "support/relative_error.hpp"

#include "scree/core/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

using namespace scree;
using test::relative_error;

TEST_CASE("random streams give the same numbers on every machine") {
  // Uniform numbers are those of the 64-bit Mersenne twister (Nishimura 2000), seeded by splitmix64 of the
  // seed and FNV-1a of the name, over 2^64: worked out by an independent program. The others are pinned as
  // they were first drawn.
  Random plain{1};
  CHECK(plain.uniform() == 0.4466657086358743);
  CHECK(plain.uniform() == 0.6371314319105348);
  CHECK(plain.uniform() == 0.8202182708899708);
  Random named{1, "shapes"};
  CHECK(named.uniform() == 0.30012565304152045);
  CHECK(named.uniform() == 0.9671788502820289);
  CHECK(named.uniform() == 0.2627787929108234);
  Random other{2, "shapes"};
  CHECK(other.uniform() == 0.03854669391817398);

  Random normal{3};
  CHECK(relative_error(normal.normal(), 0.83347317807215227) < 1e-15);
  CHECK(relative_error(normal.normal(), -0.43112367085273079) < 1e-15);
  Random index{4};
  std::vector<std::size_t> drawn(8);
  std::generate(drawn.begin(), drawn.end(), [&] { return index.index(100); });
  CHECK(drawn == std::vector<std::size_t>{58, 89, 45, 70, 35, 45, 94, 16});
  Random turn{5};
  const Quaternion q = turn.orientation();
  CHECK((q.coeffs() -
         Quaternion{0.12876844868159523, 0.28611868275103258, -0.27499253618366548, -0.90880905092776498}
             .coeffs())
            .norm() < 1e-15);
  Random order{6};
  std::vector<int> items(8);
  std::iota(items.begin(), items.end(), 0);
  order.shuffle(std::span<int>{items});
  CHECK(items == std::vector<int>{4, 1, 0, 3, 5, 7, 2, 6});
}

TEST_CASE("streams of one seed and different names do not follow each other") {
  Random a{7, "sizes"}, b{7, "orientations"};
  const int count = 20000;
  double sum = 0.0;
  for (int k = 0; k < count; ++k) {
    sum += (a.uniform() - 0.5) * (b.uniform() - 0.5);
  }
  // Mean 0 and standard deviation 1/12/sqrt(n) if independent.
  CHECK(std::abs(sum / count) < 4.0 / 12.0 / std::sqrt(count));
}

TEST_CASE("uniform and normal numbers have the moments of their distributions") {
  Random random{8};
  const int count = 40000;
  double sum = 0.0, square = 0.0, third = 0.0, fourth = 0.0;
  double least = 1.0, most = 0.0;
  for (int k = 0; k < count; ++k) {
    const double u = random.uniform();
    least = std::min(least, u);
    most = std::max(most, u);
    const double x = random.normal();
    sum += x;
    square += x * x;
    third += x * x * x;
    fourth += x * x * x * x;
  }
  // Four standard deviations of each mean: moments of the normal distribution are 0, 1, 0, 3, its 4th, 6th
  // and 8th 3, 15 and 105.
  const double n = count;
  CHECK(std::abs(sum / n) < 4.0 / std::sqrt(n));
  CHECK(std::abs(square / n - 1.0) < 4.0 * std::sqrt(2.0 / n));
  CHECK(std::abs(third / n) < 4.0 * std::sqrt(15.0 / n));
  CHECK(std::abs(fourth / n - 3.0) < 4.0 * std::sqrt(96.0 / n));
  CHECK(least >= 0.0);
  CHECK(most < 1.0);
  CHECK(least < 10.0 / n);
  CHECK(most > 1.0 - 10.0 / n);
}

TEST_CASE("an index is drawn from its range with equal chance") {
  Random random{9};
  std::vector<int> hits(6, 0);
  const int count = 24000;
  for (int k = 0; k < count; ++k) {
    const std::size_t i = random.index(hits.size());
    REQUIRE(i < hits.size());
    ++hits[i];
  }
  double chi2 = 0.0;
  for (const int h : hits) {
    chi2 += (h - count / 6.0) * (h - count / 6.0) / (count / 6.0);
  }
  CHECK(chi2 < 20.5); // 5 degrees of freedom, 99.9 %
  CHECK(random.index(1) == 0);
}

TEST_CASE("orientations are unit quaternions without a preferred direction") {
  Random random{10};
  const int count = 20000;
  Matrix mean = Matrix::Zero();
  Matrix square = Matrix::Zero();
  for (int k = 0; k < count; ++k) {
    const Quaternion q = random.orientation();
    REQUIRE(std::abs(q.norm() - 1.0) < 1e-14);
    const Matrix r = q.toRotationMatrix();
    mean += r / count;
    square += r.cwiseProduct(r) / count;
  }
  // Entries of a uniform rotation have mean 0 and variance 1/3; their squares have variance 1/5 - 1/9.
  CHECK(mean.cwiseAbs().maxCoeff() < 4.5 * std::sqrt(1.0 / 3.0 / count));
  CHECK((square.array() - 1.0 / 3.0).abs().maxCoeff() < 4.5 * std::sqrt((1.0 / 5.0 - 1.0 / 9.0) / count));
}

TEST_CASE("shuffling keeps the items and reaches every order") {
  Random random{11};
  std::vector<int> seen(6, 0);
  for (int k = 0; k < 6000; ++k) {
    std::vector<int> items{0, 1, 2};
    random.shuffle(std::span<int>{items});
    ++seen[static_cast<std::size_t>(items[0] * 2 + (items[1] > items[2] ? 1 : 0))];
    REQUIRE(items[0] + items[1] + items[2] == 3);
    REQUIRE(items[0] * items[0] + items[1] * items[1] + items[2] * items[2] == 5);
  }
  for (const int s : seen) {
    CHECK(std::abs(s - 1000) < 4.0 * std::sqrt(1000.0 * 5.0 / 6.0));
  }
}
