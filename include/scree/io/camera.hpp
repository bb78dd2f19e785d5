#pragma once
/// \file
/// Where a picture is taken from, and how places in space and in the picture belong together.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"

#include <limits>

namespace scree {

/// A camera without perspective, or with it if `distance` is above 0. The defaults give a side view along +y
/// with +x to the right and +z upwards.
struct Camera {
  Vector target = Vector::Zero();     ///< m, the place in the middle of the picture
  Vector direction = Vector::UnitY(); ///< from the camera to the target, of any length above 0
  Vector up = Vector::UnitZ();        ///< upwards in the picture, not along `direction`
  double width = 1.0;                 ///< m, breadth of the view at the target, above 0
  double distance = 0.0;              ///< m, from the eye to the target; 0 for no perspective
};

/// A camera at work on a picture of given size. View coordinates are metres to the right, upwards and into
/// the scene, from the eye or, without perspective, from the target.
class View {
public:
  struct Ray {
    Vector origin;
    Vector step; ///< its third component is 1, so that the distance along the ray is the depth
  };

  /// \throws Error if a field of the camera is outside its range.
  View(const Camera& camera, int width, int height)
      : perspective_{camera.distance > 0.0},
        half_width_{0.5 * width},
        half_height_{0.5 * height},
        pixels_per_metre_{width / require_positive("camera width", camera.width, "m")} {
    require("camera distance", camera.distance, {0.0, 1e9, "m"});
    const Vector right = camera.direction.cross(camera.up);
    if (!(right.norm() > 1e-9 * camera.direction.norm() * camera.up.norm()) || !right.allFinite() ||
        !camera.target.allFinite()) {
      throw Error("camera direction and up must be finite vectors that are not parallel");
    }
    const Vector forward = camera.direction.normalized();
    axes_.row(0) = right.normalized();
    axes_.row(1) = right.normalized().cross(forward);
    axes_.row(2) = forward;
    origin_ = camera.target - camera.distance * forward;
    focal_ = perspective_ ? camera.distance * pixels_per_metre_ : pixels_per_metre_;
    least_depth_ = perspective_ ? 1e-3 * camera.distance : -std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] bool perspective() const { return perspective_; }
  /// The least depth that is drawn (m); without perspective there is none.
  [[nodiscard]] double least_depth() const { return least_depth_; }
  /// Scale at the target; without perspective, everywhere.
  [[nodiscard]] double pixels_per_metre() const { return pixels_per_metre_; }
  /// Scale at a depth (m, above 0 with perspective).
  [[nodiscard]] double pixels_per_metre(double depth) const { return perspective_ ? focal_ / depth : focal_; }

  [[nodiscard]] Vector to_view(const Vector& place) const { return axes_ * (place - origin_); }
  [[nodiscard]] Vector direction_to_view(const Vector& direction) const { return axes_ * direction; }

  /// Pixels from the top left, and depth in metres, of a place in view coordinates. With perspective, only
  /// for places in front of the eye.
  [[nodiscard]] Vector to_pixels(const Vector& place) const {
    const double scale = pixels_per_metre(place.z());
    return {half_width_ + place.x() * scale, half_height_ - place.y() * scale, place.z()};
  }

  /// The ray through a place in the picture, in view coordinates.
  [[nodiscard]] Ray ray(double pixel_x, double pixel_y) const {
    const double x = (pixel_x - half_width_) / focal_;
    const double y = (half_height_ - pixel_y) / focal_;
    return perspective_ ? Ray{Vector::Zero(), {x, y, 1.0}} : Ray{{x, y, 0.0}, Vector::UnitZ()};
  }

private:
  bool perspective_;
  double half_width_;
  double half_height_;
  double pixels_per_metre_;
  double focal_ = 0.0;
  double least_depth_ = 0.0;
  Vector origin_;
  Matrix axes_;
};

} // namespace scree
