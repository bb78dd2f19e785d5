#pragma once
/// \file
/// Pictures of spheres and triangle surfaces, drawn by the processor: the same input gives the same picture.
///
/// Each sample of the picture keeps the nearest surface with its normal, colour and object; shading, the
/// darkening of hollows and outlines follow once at the end. Spheres of one object (a clump) have one
/// outline.

#include "scree/core/error.hpp"
#include "scree/core/linear.hpp"
#include "scree/io/camera.hpp"
#include "scree/io/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace scree {

/// A plane that cuts a scene open: what lies on the side that `normal` points to is left out.
struct CutPlane {
  Vector point = Vector::Zero();    ///< m, any point of the plane
  Vector normal = -Vector::UnitY(); ///< of any length above 0
};

/// How a picture is drawn.
struct RenderStyle {
  Rgb background{255, 255, 255};
  Rgb outline{25, 22, 20};
  double outline_strength = 0.65; ///< 0 (none) to 1
  double hollow_strength = 0.9;   ///< darkening of gaps between grains, 0 (none) to 1
  double hollow_reach = 0.0;      ///< m, how far neighbours darken; 0 for the mean radius of the spheres
  double cut_lightness = 0.25;    ///< share of white in the faces of cut spheres, 0 to 1
  double section_width = 4.5;     ///< pixels, of the line in which a cut surface shows
  int samples = 2;                ///< per pixel and direction, 1 to 4, against ragged edges
};

/// Collects spheres, surfaces and lines and turns them into an image.
class Renderer {
public:
  /// \param width, height of the image, pixels.
  /// \throws Error for a size, camera or style outside its range.
  Renderer(int width, int height, const Camera& camera, const RenderStyle& style = {})
      : style_{checked(style)},
        blank_{width, height, style.background},
        samples_{style.samples},
        columns_{width * samples_},
        rows_{height * samples_},
        view_{camera, columns_, rows_},
        fragments_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  /// Pixels of the image per metre at the camera's target, for a scale bar.
  [[nodiscard]] double pixels_per_metre() const { return view_.pixels_per_metre() / samples_; }

  /// The place in the image (pixels from the top left) where `place` (m) is seen, for labels.
  [[nodiscard]] Eigen::Vector2d pixel(const Vector& place) const {
    return view_.to_pixels(view_.to_view(place)).head<2>() / samples_;
  }

  /// Cuts all that is drawn from now on, until `uncut`.
  /// \throws Error for a plane without a direction.
  void cut(const CutPlane& plane) {
    if (!(plane.normal.norm() > 0.0) || !plane.normal.allFinite() || !plane.point.allFinite()) {
      throw Error("the normal of a cut must be a finite vector of length above 0");
    }
    const Vector normal = view_.direction_to_view(plane.normal.normalized());
    cut_ = Half{normal, normal.dot(view_.to_view(plane.point))};
  }
  void uncut() { cut_.reset(); }

  /// Draws a sphere (m, radius above 0). A cut sphere shows a flat face.
  void sphere(const Vector& centre, double radius, Rgb colour, std::uint32_t object) {
    const Vector c = view_.to_view(centre);
    if (!(radius > 0.0) || (cut_ && cut_->distance(c) >= radius)) {
      return;
    }
    radius_sum_ += radius;
    ++sphere_count_;
    const auto box = sphere_box(c, radius);
    if (!box) {
      return;
    }
    const bool may_be_cut = cut_ && cut_->distance(c) > -radius;
    for (int y = box->top; y < box->bottom; ++y) {
      for (int x = box->left; x < box->right; ++x) {
        const auto ray = view_.ray(x + 0.5, y + 0.5);
        const Vector to_centre = c - ray.origin;
        const double a = ray.step.squaredNorm();
        const double b = ray.step.dot(to_centre);
        const double discriminant = b * b - a * (to_centre.squaredNorm() - radius * radius);
        if (discriminant < 0.0) {
          continue;
        }
        const double root = std::sqrt(discriminant);
        const double depth = (b - root) / a;
        auto& fragment = at(x, y);
        if (static_cast<float>(depth) >= fragment.depth) {
          continue;
        }
        const Vector hit = ray.origin + depth * ray.step;
        if (!may_be_cut || cut_->distance(hit) <= 0.0) {
          place(fragment, depth, (hit - c) / radius, colour, object, Kind::sphere);
        } else if (cut_->distance(ray.origin + (b + root) / a * ray.step) < 0.0) {
          place(fragment, cut_->crossing(ray.origin, ray.step), cut_->normal,
                blend(colour, {255, 255, 255}, style_.cut_lightness), object, Kind::face);
        }
      }
    }
  }

  /// Draws triangles over shared vertices (m), seen from both sides, with lines along their sharp edges.
  /// Where a cut passes through them it shows as a line, so that a plate is seen edge-on too.
  /// \throws Error for a facet that names no vertex.
  void surface(std::span<const Vector> vertices, std::span<const std::array<std::uint32_t, 3>> facets,
               Rgb colour, std::uint32_t object) {
    std::vector<Vector> seen(vertices.size());
    std::transform(vertices.begin(), vertices.end(), seen.begin(),
                   [this](const Vector& vertex) { return view_.to_view(vertex); });
    for (const auto& facet : facets) {
      if (*std::max_element(facet.begin(), facet.end()) >= vertices.size()) {
        throw Error(message("a facet names a vertex beyond the ", vertices.size(), " of its surface"));
      }
      const Corners corners{seen[facet[0]], seen[facet[1]], seen[facet[2]]};
      triangle(corners, colour, object);
      section(corners, blend(colour, style_.outline, 0.25), object);
    }
  }

  /// Draws a straight line (m) of `width` pixels; what is in front of it hides it.
  void line(const Vector& from, const Vector& to, Rgb colour, double width = 2.0) {
    stroke(view_.to_view(from), view_.to_view(to), colour, width, line_object, cut_);
  }

  /// The picture of all that was drawn.
  [[nodiscard]] Image image() const {
    Image image = blank_;
    const auto hollows = smoothed_hollows();
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const double open = 1.0 - style_.hollow_strength * hollows[pixel_index(x, y)];
        std::array<double, 3> sum{};
        for (int sub = 0; sub < samples_ * samples_; ++sub) {
          const auto colour = shaded(x * samples_ + sub % samples_, y * samples_ + sub / samples_, open);
          for (std::size_t channel = 0; channel < 3; ++channel) {
            sum[channel] += colour[channel];
          }
        }
        const auto channel = [&](std::size_t i) {
          return static_cast<std::uint8_t>(std::lround(sum[i] / (samples_ * samples_)));
        };
        image.at(x, y) = {channel(0), channel(1), channel(2)};
      }
    }
    return image;
  }

private:
  using Corners = std::array<Vector, 3>;

  enum class Kind : std::uint8_t { background, sphere, face, facet, line };

  /// What one sample of the picture shows.
  struct Fragment {
    float depth = std::numeric_limits<float>::infinity();
    std::array<float, 3> normal{};
    std::uint32_t object = 0;
    Rgb colour;
    Kind kind = Kind::background;
  };

  /// The half space that is kept, in view coordinates: where `distance` is not above 0.
  struct Half {
    Vector normal;
    double offset;
    [[nodiscard]] double distance(const Vector& place) const { return normal.dot(place) - offset; }
    [[nodiscard]] double crossing(const Vector& origin, const Vector& step) const {
      return (offset - normal.dot(origin)) / normal.dot(step);
    }
  };

  /// Samples from `left` to before `right` and from `top` to before `bottom`.
  struct Box {
    int left, right, top, bottom;
  };

  static constexpr std::uint32_t line_object = std::numeric_limits<std::uint32_t>::max();

  static const RenderStyle& checked(const RenderStyle& style) {
    require("samples per pixel", style.samples, {1, 4});
    require("outline strength", style.outline_strength, {0, 1});
    require("hollow strength", style.hollow_strength, {0, 1});
    require("hollow reach", style.hollow_reach, {0, 1e9, "m"});
    require("cut lightness", style.cut_lightness, {0, 1});
    require("section width", style.section_width, {0, 100, "pixels"});
    return style;
  }

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] Fragment& at(int x, int y) { return fragments_[index(x, y)]; }
  [[nodiscard]] const Fragment& at(int x, int y) const { return fragments_[index(x, y)]; }
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && x < columns_ && y >= 0 && y < rows_; }

  /// The part of the picture between two corners, or nothing. Corners may lie far outside, or be NaN.
  [[nodiscard]] std::optional<Box> clipped(double left, double right, double top, double bottom) const {
    if (!(left < columns_ && right > 0.0 && top < rows_ && bottom > 0.0)) {
      return std::nullopt;
    }
    return Box{static_cast<int>(std::max(left, 0.0)),
               static_cast<int>(std::ceil(std::min(right, static_cast<double>(columns_)))),
               static_cast<int>(std::max(top, 0.0)),
               static_cast<int>(std::ceil(std::min(bottom, static_cast<double>(rows_))))};
  }

  /// The samples that a sphere may cover; nothing for one that reaches behind the eye.
  [[nodiscard]] std::optional<Box> sphere_box(const Vector& c, double radius) const {
    if (!view_.perspective()) {
      const Vector low = view_.to_pixels(c - Vector{radius, -radius, 0.0});
      const Vector high = view_.to_pixels(c + Vector{radius, -radius, 0.0});
      return clipped(low.x(), high.x(), low.y(), high.y());
    }
    if (c.z() - radius < view_.least_depth()) {
      return std::nullopt;
    }
    // Seen along one axis a sphere is a circle, bounded by its two tangents from the eye.
    const auto tangents = [&](double sideways) {
      const double middle = std::atan2(sideways, c.z());
      const double half = std::asin(radius / std::hypot(sideways, c.z()));
      return std::pair{std::tan(middle - half), std::tan(middle + half)};
    };
    const auto across = tangents(c.x());
    const auto upright = tangents(c.y());
    const Vector low = view_.to_pixels({across.first, upright.second, 1.0});
    const Vector high = view_.to_pixels({across.second, upright.first, 1.0});
    return clipped(low.x(), high.x(), low.y(), high.y());
  }

  static void place(Fragment& fragment, double depth, const Vector& normal, Rgb colour, std::uint32_t object,
                    Kind kind) {
    const auto nearer = static_cast<float>(depth);
    if (nearer < fragment.depth) {
      const Eigen::Vector3f n = normal.cast<float>();
      fragment = {nearer, {n.x(), n.y(), n.z()}, object, colour, kind};
    }
  }

  void triangle(const Corners& corners, Rgb colour, std::uint32_t object) {
    const Vector edge1 = corners[1] - corners[0];
    const Vector edge2 = corners[2] - corners[0];
    const Vector normal = edge1.cross(edge2).stableNormalized();
    const auto box = triangle_box(corners);
    if (!(normal.squaredNorm() > 0.5) || !box) { // without area, or out of sight
      return;
    }
    for (int y = box->top; y < box->bottom; ++y) {
      for (int x = box->left; x < box->right; ++x) {
        const auto ray = view_.ray(x + 0.5, y + 0.5);
        const auto depth = crossing(ray, corners[0], edge1, edge2);
        if (depth && *depth >= view_.least_depth() &&
            !(cut_ && cut_->distance(ray.origin + *depth * ray.step) > 0.0)) {
          const double side = normal.dot(ray.step) > 0.0 ? -1.0 : 1.0;
          place(at(x, y), *depth, side * normal, colour, object, Kind::facet);
        }
      }
    }
  }

  [[nodiscard]] std::optional<Box> triangle_box(const Corners& corners) const {
    Corners pixels;
    for (std::size_t i = 0; i < 3; ++i) {
      if (corners[i].z() < view_.least_depth()) {
        return Box{0, columns_, 0, rows_}; // reaches behind the eye: rare, so simply all of the picture
      }
      pixels[i] = view_.to_pixels(corners[i]);
    }
    const auto across = std::minmax({pixels[0].x(), pixels[1].x(), pixels[2].x()});
    const auto down = std::minmax({pixels[0].y(), pixels[1].y(), pixels[2].y()});
    return clipped(across.first, across.second, down.first, down.second);
  }

  /// Depth at which a ray meets a triangle (Möller & Trumbore 1997), or nothing. The slack closes the seam
  /// between triangles that share an edge.
  [[nodiscard]] static std::optional<double> crossing(const View::Ray& ray, const Vector& corner,
                                                      const Vector& edge1, const Vector& edge2) {
    constexpr double slack = 1e-9;
    const Vector p = ray.step.cross(edge2);
    const double determinant = edge1.dot(p);
    if (determinant == 0.0) {
      return std::nullopt;
    }
    const Vector s = ray.origin - corner;
    const double u = s.dot(p) / determinant;
    const Vector q = s.cross(edge1);
    const double v = ray.step.dot(q) / determinant;
    if (u < -slack || v < -slack || u + v > 1.0 + slack) {
      return std::nullopt;
    }
    return edge2.dot(q) / determinant;
  }

  /// The line in which the cut passes through a triangle.
  void section(const Corners& corners, Rgb colour, std::uint32_t object) {
    if (!cut_) {
      return;
    }
    std::array<Vector, 2> ends;
    std::size_t found = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector& a = corners[i];
      const Vector& b = corners[(i + 1) % 3];
      const double da = cut_->distance(a);
      const double db = cut_->distance(b);
      if ((da <= 0.0) != (db <= 0.0)) { // true for none or two of the three edges
        ends[found++] = a + da / (da - db) * (b - a);
      }
    }
    if (found == 2) {
      stroke(ends[0], ends[1], colour, style_.section_width, object, std::nullopt);
    }
  }

  /// A line between two places in view coordinates, of which `kept` is shown. It is brought forward by its
  /// own width so that a surface in which it lies does not hide it.
  void stroke(Vector from, Vector to, Rgb colour, double width, std::uint32_t object,
              const std::optional<Half>& kept) {
    auto& nearer = from.z() < to.z() ? from : to;
    const auto& farther = from.z() < to.z() ? to : from;
    if (farther.z() < view_.least_depth()) {
      return;
    }
    if (nearer.z() < view_.least_depth()) {
      nearer += (view_.least_depth() - nearer.z()) / (farther.z() - nearer.z()) * (farther - nearer);
    }
    const Vector a = view_.to_pixels(from);
    const Vector b = view_.to_pixels(to);
    const double half = 0.5 * width * samples_;
    const auto box = clipped(std::min(a.x(), b.x()) - half, std::max(a.x(), b.x()) + half,
                             std::min(a.y(), b.y()) - half, std::max(a.y(), b.y()) + half);
    if (!box) {
      return;
    }
    const Eigen::Vector2d along = (b - a).head<2>();
    const double squared_length = along.squaredNorm();
    for (int y = box->top; y < box->bottom; ++y) {
      for (int x = box->left; x < box->right; ++x) {
        const Eigen::Vector2d offset{x + 0.5 - a.x(), y + 0.5 - a.y()};
        const double share =
            squared_length > 0.0 ? std::clamp(offset.dot(along) / squared_length, 0.0, 1.0) : 0.0;
        if ((offset - share * along).squaredNorm() > half * half) {
          continue;
        }
        // Along a straight line depth is linear in the picture, with perspective its inverse is.
        const double depth = view_.perspective() ? 1.0 / ((1.0 - share) / a.z() + share / b.z())
                                                 : a.z() + share * (b.z() - a.z());
        const auto ray = view_.ray(x + 0.5, y + 0.5);
        if (!kept || kept->distance(ray.origin + depth * ray.step) <= 0.0) {
          const double forward = 2.0 * half / view_.pixels_per_metre(depth);
          place(at(x, y), depth - forward, -Vector::UnitZ(), colour, object, Kind::line);
        }
      }
    }
  }

  [[nodiscard]] double hollow_reach() const {
    if (style_.hollow_reach > 0.0) {
      return style_.hollow_reach;
    }
    return sphere_count_ > 0 ? radius_sum_ / static_cast<double>(sphere_count_) : 20.0 / pixels_per_metre();
  }

  [[nodiscard]] std::size_t pixel_index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(blank_.width()) +
           static_cast<std::size_t>(x);
  }
  /// The sample that stands for a pixel where one is enough.
  [[nodiscard]] const Fragment& middle(int pixel_x, int pixel_y) const {
    return at(pixel_x * samples_ + samples_ / 2, pixel_y * samples_ + samples_ / 2);
  }

  /// How far each pixel lies in a hollow, 0 to 1. `hollow` looks into other directions at each pixel of a
  /// tile; the mean over a tile then has the smoothness of many directions at the price of a few.
  [[nodiscard]] std::vector<float> smoothed_hollows() const {
    std::vector<float> raw(blank_.pixels().size(), 0.0F);
    if (style_.hollow_strength == 0.0) {
      return raw;
    }
    const double reach = hollow_reach();
    for (int y = 0; y < blank_.height(); ++y) {
      for (int x = 0; x < blank_.width(); ++x) {
        raw[pixel_index(x, y)] = static_cast<float>(hollow(x, y, reach));
      }
    }
    auto smooth = raw;
    for (int y = 0; y < blank_.height(); ++y) {
      for (int x = 0; x < blank_.width(); ++x) {
        const auto& here = middle(x, y);
        float sum = 0.0F;
        float count = 0.0F;
        for (int ny = std::max(0, y - tile / 2); ny < std::min(y + tile / 2, blank_.height()); ++ny) {
          for (int nx = std::max(0, x - tile / 2); nx < std::min(x + tile / 2, blank_.width()); ++nx) {
            // Only over the same surface, so that the darkness of a gap does not leak onto the grain before
            // it.
            if (const auto& there = middle(nx, ny); there.object == here.object && there.kind == here.kind) {
              sum += raw[pixel_index(nx, ny)];
              count += 1.0F;
            }
          }
        }
        smooth[pixel_index(x, y)] = sum / count;
      }
    }
    return smooth;
  }

  /// How much neighbours close off the surface seen at a pixel, 0 to 1: the mean rise of the surroundings
  /// above its tangent plane (after the horizon-based ambient occlusion of Bavoil, Sainz & Dimitrov 2008).
  [[nodiscard]] double hollow(int pixel_x, int pixel_y, double reach) const {
    const auto& here = middle(pixel_x, pixel_y);
    if (here.kind != Kind::sphere && here.kind != Kind::facet) {
      return 0.0;
    }
    const int x = pixel_x * samples_ + samples_ / 2;
    const int y = pixel_y * samples_ + samples_ / 2;
    const Vector place = on_ray(x, y, here);
    const Vector normal{here.normal[0], here.normal[1], here.normal[2]};
    const double pixels = reach * view_.pixels_per_metre(place.z());
    double closed = 0.0;
    const int of_tile = tile * (pixel_y % tile) + pixel_x % tile;
    for (const auto& direction : directions_[static_cast<std::size_t>(of_tile)]) {
      double most = 0.0;
      for (const double radius : {0.3, 0.7, 1.3}) {
        const double sx = x + std::round(radius * pixels * direction.x());
        const double sy = y + std::round(radius * pixels * direction.y());
        if (!(sx >= 0.0 && sx < columns_ && sy >= 0.0 && sy < rows_)) {
          continue;
        }
        const auto& there = at(static_cast<int>(sx), static_cast<int>(sy));
        if (there.kind == Kind::background || there.kind == Kind::line) {
          continue;
        }
        const Vector rise = on_ray(static_cast<int>(sx), static_cast<int>(sy), there) - place;
        const double distance = rise.norm();
        if (distance > 0.0) {
          // What is far in front belongs to another layer: it hides, but does not close off.
          const double fade = std::clamp(2.0 - distance / (1.5 * reach), 0.0, 1.0);
          most = std::max(most, fade * (rise.dot(normal) / distance - 0.1));
        }
      }
      closed += most;
    }
    return std::min(1.0, closed / static_cast<double>(directions_.front().size()));
  }

  static constexpr int tile = 4; ///< pixels
  /// Directions, with lengths of 0.75 to 1.25, for each pixel of a tile.
  using Directions = std::array<std::array<Eigen::Vector2d, 6>, static_cast<std::size_t>(tile) * tile>;

  static Directions directions() {
    constexpr double turn = 2.0 * 3.14159265358979323846;
    Directions result;
    for (std::size_t k = 0; k < result.size(); ++k) {
      auto& star = result[k];
      // Steps of 7 and 11, which share no factor with 16, spread angles and lengths over the tile.
      const double turned = static_cast<double>(7 * k % result.size()) / static_cast<double>(result.size());
      const double length =
          0.75 + 0.5 * static_cast<double>(11 * k % result.size()) / static_cast<double>(result.size());
      for (std::size_t i = 0; i < star.size(); ++i) {
        const double angle = turn * (static_cast<double>(i) + turned) / static_cast<double>(star.size());
        star[i] = length * Eigen::Vector2d{std::cos(angle), std::sin(angle)};
      }
    }
    return result;
  }

  [[nodiscard]] Vector on_ray(int x, int y, const Fragment& fragment) const {
    const auto ray = view_.ray(x + 0.5, y + 0.5);
    return ray.origin + static_cast<double>(fragment.depth) * ray.step;
  }

  /// Colour of one sample, channels 0 to 255; `open` is 1 in the open and falls in a hollow.
  [[nodiscard]] std::array<double, 3> shaded(int x, int y, double open) const {
    const auto& fragment = at(x, y);
    if (fragment.kind == Kind::background) {
      return {1.0 * style_.background.red, 1.0 * style_.background.green, 1.0 * style_.background.blue};
    }
    double light = 1.0;
    if (fragment.kind == Kind::sphere || fragment.kind == Kind::facet) {
      // From the upper left behind the camera; surfaces that look up are a little lighter.
      const Vector towards_light = Vector{-0.4, 0.57, -0.72}.normalized();
      const Vector normal{fragment.normal[0], fragment.normal[1], fragment.normal[2]};
      light = (0.42 + 0.12 * normal.y() + 0.62 * std::max(0.0, normal.dot(towards_light))) * open;
    }
    const double ink = outlined(x, y) ? style_.outline_strength : 0.0;
    const auto channel = [light, ink](std::uint8_t value, std::uint8_t line) {
      return (1.0 - ink) * std::min(255.0, light * value) + ink * line;
    };
    return {channel(fragment.colour.red, style_.outline.red),
            channel(fragment.colour.green, style_.outline.green),
            channel(fragment.colour.blue, style_.outline.blue)};
  }

  /// Whether a sample lies at the border of its object, or at a sharp edge of a surface.
  [[nodiscard]] bool outlined(int x, int y) const {
    const auto& here = at(x, y);
    if (here.kind == Kind::line) {
      return false;
    }
    const auto borders = [&](int nx, int ny) {
      if (!contains(nx, ny) || at(nx, ny).kind == Kind::line) {
        return false;
      }
      const auto& there = at(nx, ny);
      if (here.object != there.object || there.kind == Kind::background) {
        return true;
      }
      if (here.kind == Kind::facet && there.kind == Kind::facet) {
        const float cosine = here.normal[0] * there.normal[0] + here.normal[1] * there.normal[1] +
                             here.normal[2] * there.normal[2];
        return cosine < 0.9F;
      }
      return (here.kind == Kind::face) != (there.kind == Kind::face);
    };
    return borders(x + 1, y) || borders(x - 1, y) || borders(x, y + 1) || borders(x, y - 1);
  }

  RenderStyle style_;
  Image blank_;
  int samples_;
  int columns_; ///< samples across
  int rows_;    ///< samples down
  View view_;
  std::vector<Fragment> fragments_;
  Directions directions_ = directions();
  std::optional<Half> cut_;
  double radius_sum_ = 0.0; ///< m
  std::size_t sphere_count_ = 0;
};

} // namespace scree
