#pragma once
/// \file
/// Seeded random streams that give the same numbers on every machine and compiler.
///
/// The standard library leaves its distributions to the implementation; Boost.Random does not.

#include "scree/core/linear.hpp"

#include <boost/random/chi_squared_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <locale>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

namespace scree {

/// One stream of random numbers. Streams of one seed and different names are independent of each other, so
/// that a new consumer of random numbers does not shift those of the old ones.
class Random {
public:
  explicit Random(std::uint64_t seed, std::string_view name = "") : engine_{mixed(seed, name)} {}

  /// Uniform in [0, 1).
  double uniform() { return boost::random::uniform_01<double>{}(engine_); }
  /// Uniform in [least, most).
  double uniform(double least, double most) { return least + (most - least) * uniform(); }
  /// Uniform among 0 .. count - 1; count at least 1.
  std::size_t index(std::size_t count) {
    return boost::random::uniform_int_distribution<std::size_t>{0, count - 1}(engine_);
  }
  /// Normal with zero mean and unit variance.
  double normal() { return boost::random::normal_distribution<double>{}(engine_); }
  /// Chi-squared with `freedom` degrees of freedom, above 0.
  double chi_squared(double freedom) {
    return boost::random::chi_squared_distribution<double>{freedom}(engine_);
  }
  /// Uniform over all orientations.
  Quaternion orientation() {
    Quaternion q;
    do {
      q = Quaternion{normal(), normal(), normal(), normal()};
    } while (q.norm() < 1e-6);
    return q.normalized();
  }
  template <class T>
  void shuffle(std::span<T> items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      std::swap(items[i - 1], items[index(i)]);
    }
  }

  /// Where the stream is (core/archive.hpp).
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    std::stringstream text;
    text.imbue(std::locale::classic());
    text << self.engine_;
    std::string state = text.str();
    archive(state);
    if constexpr (Archive::reading) {
      text.str(state + ' '); // behind the last number its reader looks for more
      text.clear();
      text >> self.engine_;
      if (!text) {
        archive.fail("a stream of random numbers is not what it should be");
      }
    }
  }

private:
  static std::uint64_t mixed(std::uint64_t seed, std::string_view name) {
    // FNV-1a of the name, then the finaliser of splitmix64 over both (Steele, Lea & Flood 2014).
    std::uint64_t h = 14695981039346656037ULL;
    for (const char c : name) {
      h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    }
    std::uint64_t z = seed + 0x9e3779b97f4a7c15ULL + h;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  boost::random::mt19937_64 engine_;
};

} // namespace scree
