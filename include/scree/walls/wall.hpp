#pragma once
/// \file
/// A wall body: surfaces that move together.

#include "scree/geometry/cylinder.hpp"
#include "scree/geometry/mesh_surface.hpp"
#include "scree/geometry/plane.hpp"
#include "scree/material/material.hpp"
#include "scree/walls/concept.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace scree {

/// A surface in the frame of its wall body, and what it is made of.
class WallSurface {
public:
  WallSurface(const Plane& plane, MaterialId of) : shape_{checked(plane)}, material_{of} {}
  WallSurface(const Cylinder& cylinder, MaterialId of)
      : shape_{checked(cylinder)}, material_{of}, extent_{extent_of(std::get<Cylinder>(shape_))} {}
  WallSurface(TriangleMesh mesh, MaterialId of)
      : shape_{std::make_shared<const MeshSurface>(std::move(mesh))},
        material_{of},
        extent_{extent_of(this->mesh()->mesh())} {}

  [[nodiscard]] MaterialId material() const { return material_; }

  /// Whether a sphere within `reach` [m] of `centre` could touch; for a mesh also which facets.
  bool near(const Vector& centre, double reach, std::vector<std::uint32_t>& facets) const {
    if (const auto* mesh = this->mesh()) {
      const std::size_t before = facets.size();
      mesh->facets_near(centre, reach, facets);
      return facets.size() > before;
    }
    const auto* plane = std::get_if<Plane>(&shape_);
    return plane != nullptr ? plane->near(centre, reach) : std::get<Cylinder>(shape_).near(centre, reach);
  }

  /// Appends the contacts of a sphere, for a mesh with these facets. Returns a gap [m] that there is at
  /// least, 0 or below where it touches.
  double touch(std::span<const std::uint32_t> facets, const Vector& centre, double radius,
               SurfaceContacts& contacts) const {
    if (const auto* mesh = this->mesh()) {
      return mesh->touch(facets, centre, radius, contacts);
    }
    const auto* plane = std::get_if<Plane>(&shape_);
    return plane != nullptr ? plane->touch(centre, radius, contacts)
                            : std::get<Cylinder>(shape_).touch(centre, radius, contacts);
  }

  /// Whether it has facets of these numbers.
  [[nodiscard]] bool has_facets(std::span<const std::uint32_t> facets) const {
    const std::size_t count = mesh() != nullptr ? mesh()->mesh().facets.size() : 0;
    return std::all_of(facets.begin(), facets.end(), [&](std::uint32_t facet) { return facet < count; });
  }

  /// The mesh behind this surface, or null.
  [[nodiscard]] const MeshSurface* mesh() const {
    const auto* held = std::get_if<std::shared_ptr<const MeshSurface>>(&shape_);
    return held != nullptr ? held->get() : nullptr;
  }

  /// m, of the farthest point from the origin of the wall's frame; infinite for a plane.
  [[nodiscard]] double extent() const { return extent_; }

private:
  static double extent_of(const TriangleMesh& mesh) {
    double most = 0.0;
    for (const Vector& v : mesh.vertices) {
      most = std::max(most, v.norm());
    }
    return most;
  }
  static double extent_of(const Cylinder& tube) {
    const double end = std::isinf(tube.length) ? tube.length : (tube.base + tube.length * tube.axis).norm();
    return std::max(tube.base.norm(), end) + tube.radius;
  }

  std::variant<Plane, Cylinder, std::shared_ptr<const MeshSurface>> shape_;
  MaterialId material_;
  double extent_ = std::numeric_limits<double>::infinity();
};

/// Surfaces with one motion and one way of being moved.
template <class Dynamics>
struct Wall {
  std::string name;
  std::vector<WallSurface> surfaces;
  Dynamics dynamics;
  WallMotion motion{};
  WallLoad load{};

  /// What changes while it moves; its surfaces are those that it was made with.
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.motion, self.load, self.dynamics);
  }

  /// 1/kg, as a contact sees it; 0 for a wall that does not give way to forces.
  [[nodiscard]] double inverse_mass() const {
    return std::visit(
        [](const auto& d) {
          if constexpr (GivesWay<std::decay_t<decltype(d)>>) {
            return static_cast<double>(d.mobility(0.0));
          } else {
            return 0.0;
          }
        },
        dynamics);
  }

  /// m, of its farthest point from the origin of its frame.
  [[nodiscard]] double extent() const {
    double most = 0.0;
    for (const WallSurface& surface : surfaces) {
      most = std::max(most, surface.extent());
    }
    return most;
  }
};

/// The kinds of wall dynamics that a model allows, e.g. `Walls<Fixed, RopeCoupled>`.
template <class... Dynamics>
struct Walls {
  /// A dynamics of one of these kinds. Refuses any other by name, also a type derived from one of them, of
  /// which a bare variant would keep only the base.
  class Any : public std::variant<Dynamics...> {
  public:
    Any() = default;
    template <class D>
    requires(!std::is_base_of_v<Any, D>)
        // NOLINTNEXTLINE(google-explicit-constructor): as the variant itself
        Any(D dynamics)
        : std::variant<Dynamics...>{listed(std::move(dynamics))} {}

    template <class Self, class Archive>
    static void fields(Self& self, Archive& archive) {
      using One = std::variant<Dynamics...>;
      archive(static_cast<std::conditional_t<std::is_const_v<Self>, const One, One>&>(self));
    }

  private:
    template <class D>
    static std::variant<Dynamics...> listed(D dynamics) {
      constexpr bool is_listed = (std::is_same_v<D, Dynamics> || ...);
      static_assert(is_listed, "scree: Model::Walls does not list this wall dynamics (walls/wall.hpp)");
      if constexpr (is_listed) {
        return dynamics;
      }
    }
  };
};

} // namespace scree
