#pragma once
/// \file
/// Periodic directions.

#include "scree/core/error.hpp"
#include "scree/neighbours/concept.hpp"
#include "scree/state/bodies.hpp"
#include "scree/state/pair_list.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace scree {

/// Space that repeats with a period [m] from 0 in each direction where the period is above 0.
class Domain {
public:
  /// \throws Error for a negative period or one that is not a number.
  explicit Domain(const Vector& period) : period_{period} {
    for (int d = 0; d < 3; ++d) {
      require(message("period[", d, "]"), period[d], {0.0, 1e300, "m"});
    }
    for (std::uint32_t image = 0; image < shifts_.size(); ++image) {
      const auto along = [&](std::uint32_t digit, double length) {
        return (static_cast<double>(digit) - 1.0) * length;
      };
      shifts_[image] = {along(image % 3, period[0]), along(image / 3 % 3, period[1]),
                        along(image / 9, period[2])};
    }
  }

  [[nodiscard]] bool periodic() const { return period_.maxCoeff() > 0.0; }
  /// m, by which image number `image` (see Partner) of a sphere is away from the sphere.
  [[nodiscard]] const Vec3<double>& shift(std::uint32_t image) const { return shifts_[image]; }

  /// Whether the centre of a body is further outside than a tenth of a period.
  template <class Real>
  [[nodiscard]] bool strayed(const Bodies<Real>& bodies) const {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vector x = bodies.position(b);
      for (int d = 0; d < 3; ++d) {
        if (period_[d] > 0.0 && std::abs(x[d] / period_[d] - 0.5) > 0.6) {
          return true;
        }
      }
    }
    return false;
  }

  /// Brings the centres of all bodies back into the domain and calls `shifted(b, by)` for each that was
  /// outside, with the way [m] that it was moved. Returns whether there was one.
  template <class Real, class Shifted>
  bool wrap(Bodies<Real>& bodies, Shifted shifted) const {
    bool any = false;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vector x = bodies.position(b);
      Vector by = Vector::Zero();
      for (int d = 0; d < 3; ++d) {
        if (period_[d] > 0.0) {
          by[d] = -period_[d] * std::floor(x[d] / period_[d]);
        }
      }
      if (!by.isZero(0.0)) {
        bodies.shift(b, by);
        shifted(b, by);
        any = true;
      }
    }
    return any;
  }

  /// The owner and image of a ball behind the owned ones.
  struct Image {
    std::uint32_t owner;
    std::uint32_t image;
  };

  /// Appends to `balls` the images of those within `reach` [m] of a periodic boundary.
  /// \throws Error where a period is too short for a pair to touch through one image only.
  void add_images(std::vector<Ball>& balls, double reach, std::vector<Image>& images) const {
    images.clear();
    for (int d = 0; d < 3; ++d) {
      if (period_[d] > 0.0 && period_[d] < 3.0 * reach) {
        throw Error(message("period[", d, "] = ", period_[d],
                            " m must be at least three times the reach of a contact, ", 3.0 * reach, " m"));
      }
    }
    // Members of clumps, and bodies that have not been wrapped for a while, lie beyond the domain themselves.
    const Box3 occupied = bounds(balls);
    const std::size_t owned = balls.size();
    for (std::uint32_t image = 0; image < shifts_.size(); ++image) {
      if (image == Partner::here || !exists(image)) {
        continue;
      }
      for (std::size_t k = 0; k < owned; ++k) {
        const Ball moved{balls[k].centre + shifts_[image], balls[k].radius};
        if (near(occupied, moved.centre, reach)) {
          balls.push_back(moved);
          images.push_back({static_cast<std::uint32_t>(k), image});
        }
      }
    }
  }

private:
  [[nodiscard]] bool exists(std::uint32_t image) const {
    const std::array<std::uint32_t, 3> digits{image % 3, image / 3 % 3, image / 9};
    for (std::size_t d = 0; d < 3; ++d) {
      if (digits[d] != 1 && !(period_[static_cast<int>(d)] > 0.0)) {
        return false;
      }
    }
    return true;
  }

  using Box3 = Eigen::AlignedBox3d;

  static Box3 bounds(std::span<const Ball> balls) {
    Box3 box;
    for (const Ball& ball : balls) {
      box.extend(to_eigen(ball.centre));
    }
    return box;
  }

  [[nodiscard]] bool near(const Box3& occupied, const Vec3<double>& place, double reach) const {
    const Vector x = to_eigen(place);
    for (int d = 0; d < 3; ++d) {
      if (period_[d] > 0.0 && (x[d] < occupied.min()[d] - reach || x[d] > occupied.max()[d] + reach)) {
        return false;
      }
    }
    return true;
  }

  Vector period_;
  std::array<Vec3<double>, 27> shifts_{};
};

} // namespace scree
