#pragma once
/// \file
/// A size distribution as sieving gives it: what fraction of the material passes each sieve.

#include "scree/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace scree {

/// Whether the fractions of a sieve curve are fractions of the number of grains or of their mass.
enum class SieveBasis { number, mass };

inline std::string_view to_string(SieveBasis basis) {
  return basis == SieveBasis::number ? "number" : "mass";
}

/// Cumulative fraction passing against sieve opening, linear between sieves (paper, Sec. 4.2).
///
/// Grains of one shape have a mass in proportion to the cube of their size, so a curve by mass has an
/// equivalent distribution by number: between two sieves a density constant by mass is one that falls with
/// the inverse cube of size by number. Grains are drawn from number_quantile().
class SieveCurve {
public:
  /// \param openings sieve openings [m], above zero and ascending, at least two
  /// \param passing cumulative fraction that passes each, 0 to 1, never falling, from 0 at the first to 1
  ///        at the last
  /// \param basis what the fractions are fractions of
  /// \throws Error naming the first sieve (counted from 1) that is not so.
  SieveCurve(std::vector<double> openings, std::vector<double> passing, SieveBasis basis)
      : openings_{std::move(openings)}, passing_{std::move(passing)}, basis_{basis} {
    if (openings_.size() < 2 || openings_.size() != passing_.size()) {
      throw Error(message("sieve curve: ", openings_.size(), " openings and ", passing_.size(),
                          " fractions; the same number, at least 2, is needed"));
    }
    for (std::size_t i = 0; i < openings_.size(); ++i) {
      const auto sieve = message("sieve curve, sieve ", i + 1, ": ");
      require_positive(sieve + "opening", openings_[i], "m");
      require(sieve + "fraction passing", passing_[i], {0.0, 1.0});
      if (i > 0 && openings_[i] <= openings_[i - 1]) {
        throw Error(message(sieve, "opening ", openings_[i], " m is not above ", openings_[i - 1],
                            " m of the one before"));
      }
      if (i > 0 && passing_[i] < passing_[i - 1]) {
        throw Error(message(sieve, "fraction passing ", passing_[i], " is below ", passing_[i - 1],
                            " of the one before"));
      }
    }
    if (passing_.front() != 0.0 || passing_.back() != 1.0) {
      throw Error(message("sieve curve: the fraction passing runs from ", passing_.front(), " to ",
                          passing_.back(), "; it must run from 0 at the first sieve to 1 at the last"));
    }
    tabulate();
  }

  [[nodiscard]] const std::vector<double>& openings() const { return openings_; } ///< m, ascending
  /// Cumulative fraction, by basis(), that passes each opening.
  [[nodiscard]] const std::vector<double>& fractions() const { return passing_; }
  [[nodiscard]] SieveBasis basis() const { return basis_; }

  /// Fraction, by basis(), of the material that passes an opening of `size` [m].
  [[nodiscard]] double passing(double size) const {
    if (size <= openings_.front()) {
      return 0.0;
    }
    if (size >= openings_.back()) {
      return 1.0;
    }
    const std::size_t i = class_of(size);
    const double part = (size - openings_[i]) / (openings_[i + 1] - openings_[i]);
    return passing_[i] + part * (passing_[i + 1] - passing_[i]);
  }

  /// Opening [m] that a fraction `u`, by basis(), of the material passes. Where a range of openings passes
  /// the same fraction, its upper end (for u = 1 its lower end).
  /// \throws Error unless u is in [0, 1].
  [[nodiscard]] double quantile(double u) const {
    const auto [i, part] = locate(passing_, u);
    return openings_[i] + part * (openings_[i + 1] - openings_[i]);
  }

  /// Size [m] that a fraction `u` of the number of grains is smaller than. For u uniform in [0, 1) it draws
  /// one grain. Same as quantile() for a curve by number.
  /// \throws Error unless u is in [0, 1].
  [[nodiscard]] double number_quantile(double u) const {
    if (basis_ == SieveBasis::number) {
      return quantile(u);
    }
    const auto [i, part] = locate(number_passing_, u);
    const double a = 1.0 / (openings_[i] * openings_[i]);
    const double b = 1.0 / (openings_[i + 1] * openings_[i + 1]);
    const double size = 1.0 / std::sqrt(a - part * (a - b));
    return std::clamp(size, openings_[i], openings_[i + 1]);
  }

  /// Mean over the number of grains of the cube of their size [m3].
  [[nodiscard]] double mean_cubed_size() const { return mean_cubed_size_; }

  /// Index i of the class [openings()[i], openings()[i + 1]) that holds `size`; sizes outside go to the first
  /// or the last class.
  [[nodiscard]] std::size_t class_of(double size) const {
    const auto above = std::upper_bound(openings_.begin() + 1, openings_.end() - 1, size);
    return static_cast<std::size_t>(above - openings_.begin()) - 1;
  }

private:
  struct Place {
    std::size_t sieve_class;
    double part; // of the class, 0 to 1
  };

  static Place locate(const std::vector<double>& cumulative, double u) {
    require("fraction passing", u, {0.0, 1.0});
    // Never a class without material, which has no inverse.
    const auto above = u < 1.0 ? std::upper_bound(cumulative.begin(), cumulative.end(), u)
                               : std::lower_bound(cumulative.begin(), cumulative.end(), 1.0);
    const auto i = static_cast<std::size_t>(above - cumulative.begin()) - 1;
    return {i, (u - cumulative[i]) / (cumulative[i + 1] - cumulative[i])};
  }

  void tabulate() {
    number_passing_ = passing_;
    double sum = 0.0; // of grains per mass, or of cubed size per grain, over the classes
    for (std::size_t i = 0; i + 1 < openings_.size(); ++i) {
      const double a = openings_[i];
      const double b = openings_[i + 1];
      const double fraction = passing_[i + 1] - passing_[i];
      if (basis_ == SieveBasis::mass) {
        sum += fraction * 0.5 * (a + b) / (a * a * b * b); // mean over [a, b] of 1 / size^3
        number_passing_[i + 1] = sum;
      } else {
        sum += fraction * 0.25 * (a + b) * (a * a + b * b); // mean over [a, b] of size^3
      }
    }
    if (basis_ == SieveBasis::mass) {
      for (double& n : number_passing_) {
        n /= sum;
      }
      mean_cubed_size_ = 1.0 / sum;
    } else {
      mean_cubed_size_ = sum;
    }
  }

  std::vector<double> openings_;
  std::vector<double> passing_;
  std::vector<double> number_passing_;
  SieveBasis basis_;
  double mean_cubed_size_ = 0.0;
};

/// The paper's sieves, 9.5 to 37.5 mm. The fractions, by mass, are not in the text of the paper (its Fig. 8
/// has them) and are ours.
inline SieveCurve default_sieve_curve() {
  return {{9.5e-3, 13.2e-3, 19.0e-3, 26.5e-3, 37.5e-3}, {0.0, 0.10, 0.40, 0.80, 1.0}, SieveBasis::mass};
}

} // namespace scree
