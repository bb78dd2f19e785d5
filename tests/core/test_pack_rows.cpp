#include "scree/core/twin.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace {

using namespace scree;

template <class T>
struct RealOf {
  using type = T;
};
template <class Real>
struct RealOf<Pack<Real>> {
  using type = Real;
};
template <class Real>
struct RealOf<Twin<Pack<Real>>> {
  using type = Real;
};

/// Records of four numbers, far from each other and not in the order of the lanes.
template <class Real>
struct Records {
  static constexpr std::size_t stride = 7;
  std::vector<Real> numbers;

  explicit Records(std::size_t count, Real first) : numbers(count * stride) {
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      numbers[n] = first + static_cast<Real>(n);
    }
  }
  [[nodiscard]] const Real* at(std::size_t lane) const {
    return &numbers[(numbers.size() / stride - 1 - lane) * stride];
  }
};

template <class T, class Real>
void check_fields(const Fields<T>& fields, const std::function<Real(std::size_t, std::size_t)>& expected) {
  constexpr std::size_t width = Lanes<T>::width;
  for (std::size_t field = 0; field < 4; ++field) {
    std::array<Real, width> lanes{};
    Lanes<T>::store(fields[field], lanes.data());
    for (std::size_t lane = 0; lane < width; ++lane) {
      CAPTURE(field);
      CAPTURE(lane);
      CHECK(lanes[lane] == expected(lane, field));
    }
  }
}

} // namespace

#define SCREE_NUMBERS                                                                                        \
  double, float, scree::Pack<double>, scree::Pack<float>, scree::Twin<scree::Pack<double>>,                  \
      scree::Twin<scree::Pack<float>>

TEST_CASE_TEMPLATE("records are read as fields, and their differences too", T, SCREE_NUMBERS) {
  using Real = typename RealOf<T>::type;
  constexpr std::size_t width = Lanes<T>::width;
  const Records<Real> a{width, Real(1)}, b{width, Real(1000)};
  const auto row_a = [&](std::size_t lane) { return a.at(lane); };
  const auto row_b = [&](std::size_t lane) { return b.at((lane + 1) % width); };
  check_fields<T, Real>(fields_of<T>(row_a),
                        [&](std::size_t lane, std::size_t field) { return a.at(lane)[field]; });
  check_fields<T, Real>(differences_of<T>(row_a, row_b), [&](std::size_t lane, std::size_t field) {
    return a.at(lane)[field] - b.at((lane + 1) % width)[field];
  });
}

TEST_CASE_TEMPLATE("rows are brought to memory lane after lane, to shared places too", T, SCREE_NUMBERS) {
  using Real = typename RealOf<T>::type;
  constexpr std::size_t width = Lanes<T>::width;
  const Records<Real> a{width, Real(1)}, b{width, Real(1000)};
  const RowsOfEight<T> rows{fields_of<T>([&](std::size_t lane) { return a.at(lane); }),
                            fields_of<T>([&](std::size_t lane) { return b.at(lane); })};
  struct alignas(64) Eight {
    std::array<Real, 8> numbers{};
  };
  std::vector<Eight> sums(width), expected(width);
  const auto place = [](std::size_t lane) { return lane * lane % 5 % width; };
  for_each_lane<T>(
      [&](auto lane) { rows.template apply<lane>(sums[place(lane)].numbers.data(), std::plus<>{}); });
  for (std::size_t lane = 0; lane < width; ++lane) {
    for (std::size_t n = 0; n < 4; ++n) {
      expected[place(lane)].numbers[n] += a.at(lane)[n];
      expected[place(lane)].numbers[4 + n] += b.at(lane)[n];
    }
  }
  for (std::size_t k = 0; k < width; ++k) {
    CHECK(sums[k].numbers == expected[k].numbers);
  }
}

TEST_CASE_TEMPLATE("records in float are read as packs of double", T, double, Pack<double>) {
  const Records<float> a{Lanes<T>::width, 1.0F};
  check_fields<T, double>(fields_of<T>([&](std::size_t lane) { return a.at(lane); }),
                          [&](std::size_t lane, std::size_t field) { return double{a.at(lane)[field]}; });
}

namespace {

/// Stores each lane once as four numbers and once as three, and looks at what stands there then.
template <class T, class Real>
void check_stored_rows() {
  constexpr std::size_t width = Lanes<T>::width;
  const Records<double> a{width, 1.0};
  const RowsOfFour<T> rows{fields_of<T>([&](std::size_t lane) { return a.at(lane); })};
  const Real kept = Real(-3);
  std::vector<std::array<Real, 5>> four(width), three(width);
  for (std::size_t lane = 0; lane < width; ++lane) {
    four[lane].fill(kept);
    three[lane].fill(kept);
  }
  for_each_lane<T>([&](auto lane) {
    rows.template store<lane>(four[lane].data());
    rows.template store_three<lane>(three[lane].data());
  });
  for (std::size_t lane = 0; lane < width; ++lane) {
    CAPTURE(lane);
    for (std::size_t n = 0; n < 4; ++n) {
      CHECK(four[lane][n] == static_cast<Real>(a.at(lane)[n]));
      CHECK(three[lane][n] == (n < 3 ? static_cast<Real>(a.at(lane)[n]) : kept));
    }
    CHECK(four[lane][4] == kept);
    CHECK(three[lane][4] == kept);
  }
}

} // namespace

TEST_CASE_TEMPLATE("rows of four are stored, or three numbers of them", T, double, Pack<double>) {
  check_stored_rows<T, double>();
  check_stored_rows<T, float>();
}

TEST_CASE_TEMPLATE("a twin computes as its packs do", Real, double, float) {
  using P = Pack<Real>;
  using T = Twin<P>;
  constexpr std::size_t width = Lanes<T>::width;
  std::array<Real, width> a{}, b{}, out{};
  for (std::size_t lane = 0; lane < width; ++lane) {
    a[lane] = static_cast<Real>(lane) - Real(1.5);
    b[lane] = Real(0.5) + static_cast<Real>(lane * lane);
  }
  const auto check = [&](const char* name, auto operation) {
    CAPTURE(name);
    Lanes<T>::store(operation(Lanes<T>::loaded(a.data()), Lanes<T>::loaded(b.data())), out.data());
    for (const std::size_t part : {std::size_t{0}, P::width}) {
      std::array<Real, P::width> half{};
      operation(P::loaded(&a[part]), P::loaded(&b[part])).store(half.data());
      for (std::size_t lane = 0; lane < P::width; ++lane) {
        CHECK(out[part + lane] == half[lane]);
      }
    }
  };
  check("sum", [](auto x, auto y) { return x + y; });
  check("difference", [](auto x, auto y) { return x - y; });
  check("product", [](auto x, auto y) { return x * y; });
  check("quotient", [](auto x, auto y) { return x / y; });
  check("negative", [](auto x, auto) { return -x; });
  check("root", [](auto, auto y) { return square_root(y); });
  check("reciprocal", [](auto, auto y) { return reciprocal(y); });
  check("reciprocal root", [](auto, auto y) { return reciprocal_square_root(y); });
  check("larger", [](auto x, auto y) { return larger(x, y); });
  check("multiply_add", [](auto x, auto y) { return multiply_add(x, y, y); });
  check("multiply_subtract", [](auto x, auto y) { return multiply_subtract(x, y, y); });
  check("negated_multiply_add", [](auto x, auto y) { return negated_multiply_add(x, y, y); });
  check("select", [](auto x, auto y) { return select(x > y && x < y * y, x, y); });
  const T x = Lanes<T>::loaded(a.data());
  CHECK(any(x > T(a[width - 1] - Real(0.5))));
  CHECK_FALSE(any(x > T(a[width - 1])));
  for (std::size_t count = 0; count <= width; ++count) {
    CHECK(Lanes<T>::sum(select(Lanes<T>::below(count), T(1), T(0))) == static_cast<Real>(count));
  }
}
