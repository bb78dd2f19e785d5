#include "scree/diagnose/shared_design.hpp"

#include "diagnose/toy_rock.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace scree;

TEST_CASE("a shared design: base parameters evenly, few causes at a time, each as often as any other") {
  const ModelSpace space{toy::base(), toy::causes()};
  Random random{3, "design"};
  const std::size_t runs = 40;
  const auto points = shared_design(space, runs, 2, random);
  REQUIRE(points.size() == runs);
  const Eigen::VectorXd null = space.null();
  for (Eigen::Index k = 0; k < space.base(); ++k) {
    std::vector<double> values;
    for (const auto& at : points) {
      values.push_back(at[k]);
    }
    std::sort(values.begin(), values.end());
    for (std::size_t r = 0; r < runs; ++r) { // one in each step
      CHECK(std::floor(values[r] * static_cast<double>(runs)) == static_cast<double>(r));
    }
  }
  for (std::size_t r = 0; r < runs; ++r) {
    const auto& at = points[r];
    CHECK((at.tail(4).array() != null.tail(4).array()).count() == (r % 4 == 3 ? 0 : 2));
    CHECK(at.minCoeff() >= 0.0);
    CHECK(at.maxCoeff() <= 1.0);
  }
  for (Eigen::Index k = space.base(); k < space.size(); ++k) {
    const auto active =
        std::count_if(points.begin(), points.end(), [&](const auto& at) { return at[k] != null[k]; });
    CHECK(active == 15);
  }
}

TEST_CASE("a shared design deals out more causes than there are, or none") {
  const ModelSpace space{toy::base(), {toy::causes()[0]}};
  Random random{3, "design"};
  const auto points = shared_design(space, 10, 5, random);
  CHECK(std::count_if(points.begin(), points.end(), [](const auto& at) { return at[3] > 0.0; }) == 8);
  const ModelSpace bare{toy::base(), {}};
  CHECK(shared_design(bare, 10, 2, random).front().size() == 3);
}

TEST_CASE("a space of models refuses causes that make no sense") {
  const auto complaint = [](const Cause& cause) {
    try {
      const ModelSpace space{toy::base(), {cause}};
    } catch (const Error& error) {
      return std::string{error.what()};
    }
    return std::string{};
  };
  CHECK(complaint({"wind", {{"speed", "m/s", 0.0, 5.0}}, {-1.0}}) ==
        "cause wind: null value of speed = -1 m/s is outside [0, 5] m/s");
  CHECK(complaint({"wind", {{"speed", "m/s", 0.0, 5.0}}, {}}).find("1 parameters and 0 null values") !=
        std::string::npos);
  CHECK(complaint({"rust", {{"friction", "", 0.0, 1.0}}, {0.5}}) ==
        "diagnosis: parameter friction stands twice");
}
