#pragma once
/// \file
/// All rigid bodies of a simulation and their member spheres.

#include "scree/core/error.hpp"
#include "scree/geometry/clump.hpp"
#include "scree/state/activity.hpp"
#include "scree/state/placement.hpp"
#include "scree/state/records.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace scree {

/// How a body is moved.
enum class BodyKind : std::uint8_t {
  lone,  ///< one sphere about the centre of mass: its sphere record holds the motion, its orientation is not
         ///< followed
  clump, ///< any other rigid body: its body record holds the motion
  fixed  ///< never moves
};

/// A body about to be added.
struct NewBody {
  const Clump* clump = nullptr;                    ///< at unit scale
  double scale = 1.0;                              ///< factor on all lengths of the clump, above 0
  double density = 0.0;                            ///< kg/m3
  std::uint16_t material = 0;                      ///< number of its material
  Vector position = Vector::Zero();                ///< m
  Quaternion orientation = Quaternion::Identity(); ///< principal axes to space
  Vector velocity = Vector::Zero();                ///< m/s
  Vector angular_velocity = Vector::Zero();        ///< rad/s, in space
  bool fixed = false;
};

/// Bodies in the order in which they are computed (`0 .. size() - 1`), each with an id that it keeps when
/// that order changes. The spheres of a body are neighbours in the sphere arrays.
template <class Real>
class Bodies {
public:
  [[nodiscard]] std::size_t size() const { return kinds_.size(); }
  [[nodiscard]] std::size_t sphere_count() const { return spheres_.size(); }
  [[nodiscard]] bool empty() const { return kinds_.empty(); }

  /// Adds a body and returns its id.
  /// \throws Error for a value that is not a number, a scale or density of 0 or below.
  std::uint64_t add(const NewBody& given) {
    const Clump& clump = *given.clump;
    require_positive("body scale", given.scale);
    require_positive("body density", given.density, "kg/m3");
    if (!given.position.allFinite() || !given.velocity.allFinite() || !given.angular_velocity.allFinite() ||
        !given.orientation.coeffs().allFinite()) {
      throw Error(message("body ", next_id_, " ('", clump.name,
                          "'): position, orientation or velocity is not a number"));
    }
    const Quaternion q = given.orientation.normalized();
    const double s3 = given.scale * given.scale * given.scale;
    const double mass = given.density * clump.volume * s3;
    const Vector inertia = given.density * s3 * given.scale * given.scale * clump.inertia;
    const bool lone = clump.spheres.size() == 1 && clump.spheres[0].centre.isZero(0.0);

    const std::size_t b = size();
    kinds_.push_back(given.fixed ? BodyKind::fixed : lone ? BodyKind::lone : BodyKind::clump);
    activities_.push_back(given.fixed ? Activity::resting : Activity::fresh);
    ids_.push_back(next_id_);
    materials_.push_back(given.material);
    solid_volumes_.push_back(clump.union_volume * s3);
    bounding_radii_.push_back(clump.bounding_radius * given.scale);
    mobilities_.push_back(clump.mobility / mass);
    rigid_of_.push_back(none);
    for (const Sphere& member : clump.spheres) {
      SphereRecord<Real> sphere;
      sphere.radius = member.radius * given.scale;
      sphere.inverse_mass = given.fixed ? Real{0} : static_cast<Real>(1.0 / mass);
      sphere.material = given.material;
      spheres_.push_back(sphere);
      body_of_.push_back(static_cast<std::uint32_t>(b));
    }
    forces_.resize(spheres_.size());
    held_forces_.resize(held_forces_.empty() ? 0 : spheres_.size());
    first_.push_back(static_cast<std::uint32_t>(spheres_.size()));
    const Vector velocity = given.fixed ? Vector(Vector::Zero()) : given.velocity;
    const Vector spin = given.fixed ? Vector(Vector::Zero()) : given.angular_velocity;
    if (is_lone(b)) {
      SphereRecord<Real>& sphere = spheres_.back();
      sphere.position = to_vec3(given.position);
      sphere.velocity = to_vec3<Real>(velocity);
      sphere.angular_velocity = to_vec3<Real>(spin);
    } else {
      BodyRecord<Real>& body = add_record(b);
      body.position = to_vec3(given.position);
      body.orientation = to_quat(q);
      body.velocity = to_vec3<Real>(velocity);
      body.angular_velocity = to_vec3<Real>(Vector(q.conjugate() * spin));
      body.mass = static_cast<Real>(mass);
      body.inertia = to_vec3<Real>(inertia);
      for (const Sphere& member : clump.spheres) {
        members_.push_back({to_vec3(Vector(member.centre * given.scale))});
      }
      place_members(b);
    }
    return next_id_++;
  }

  // ---- what observers read
  // ------------------------------------------------------------------------------------

  [[nodiscard]] Vector position(std::size_t b) const {
    return to_eigen(is_lone(b) ? spheres_[first_[b]].position : record(b).position);
  }
  [[nodiscard]] Vector velocity(std::size_t b) const {
    return to_eigen(is_lone(b) ? spheres_[first_[b]].velocity : record(b).velocity);
  }
  /// rad/s, in space.
  [[nodiscard]] Vector angular_velocity(std::size_t b) const {
    return is_lone(b) ? to_eigen(spheres_[first_[b]].angular_velocity)
                      : Vector(orientation(b) * to_eigen(record(b).angular_velocity));
  }
  /// That of a lone sphere is not followed.
  [[nodiscard]] Quaternion orientation(std::size_t b) const {
    return is_lone(b) ? Quaternion::Identity() : to_eigen(record(b).orientation);
  }
  [[nodiscard]] double mass(std::size_t b) const {
    return is_lone(b) ? 1.0 / static_cast<double>(spheres_[first_[b]].inverse_mass)
                      : static_cast<double>(record(b).mass);
  }
  [[nodiscard]] Vector inertia(std::size_t b) const {
    if (is_lone(b)) {
      const double radius = spheres_[first_[b]].radius;
      return Vector::Constant(0.4 * mass(b) * radius * radius);
    }
    return to_eigen(record(b).inertia);
  }
  [[nodiscard]] std::uint64_t id(std::size_t b) const { return ids_[b]; }
  [[nodiscard]] BodyKind kind(std::size_t b) const { return kinds_[b]; }
  [[nodiscard]] bool is_fixed(std::size_t b) const { return kinds_[b] == BodyKind::fixed; }
  /// A fixed body always rests.
  [[nodiscard]] Activity activity(std::size_t b) const { return activities_[b]; }
  [[nodiscard]] std::uint16_t material(std::size_t b) const { return materials_[b]; }
  /// m3, of the union of its spheres.
  [[nodiscard]] double solid_volume(std::size_t b) const { return solid_volumes_[b]; }
  /// m, of the sphere about the centre of mass that holds the body.
  [[nodiscard]] double bounding_radius(std::size_t b) const { return bounding_radii_[b]; }
  /// 1/kg, acceleration of the point of its surface that gives way most under a force of 1 N.
  [[nodiscard]] double mobility(std::size_t b) const { return mobilities_[b]; }
  /// J, of translation and rotation; 0 for a fixed body.
  [[nodiscard]] double kinetic_energy(std::size_t b) const {
    const Vector v = velocity(b);
    const Vector w = orientation(b).conjugate() * angular_velocity(b);
    return 0.5 * mass(b) * v.squaredNorm() + 0.5 * w.dot(inertia(b).cwiseProduct(w));
  }

  /// Index of the first sphere of body b; of the end for b = size().
  [[nodiscard]] std::size_t first_sphere(std::size_t b) const { return first_[b]; }
  [[nodiscard]] std::uint32_t body_of(std::size_t sphere) const { return body_of_[sphere]; }
  [[nodiscard]] std::span<const SphereRecord<Real>> spheres() const { return spheres_; }
  /// What acted on each sphere in the last step: contacts only, without gravity.
  [[nodiscard]] std::span<const ForceRecord<Real>> forces() const { return forces_; }
  /// The part of them that comes from contacts between resting bodies; empty where none has rested yet.
  [[nodiscard]] std::span<const ForceRecord<Real>> held_forces() const { return held_forces_; }

  // ---- what the simulation writes
  // -----------------------------------------------------------------------------

  [[nodiscard]] std::span<SphereRecord<Real>> spheres() { return spheres_; }
  [[nodiscard]] std::span<ForceRecord<Real>> forces() { return forces_; }
  /// For each sphere.
  [[nodiscard]] std::span<ForceRecord<Real>> held_forces() {
    held_forces_.resize(spheres_.size());
    return held_forces_;
  }
  void set_activity(std::size_t b, Activity activity) { activities_[b] = activity; }
  /// Of a body that is not lone.
  [[nodiscard]] BodyRecord<Real>& record(std::size_t b) { return rigid_[rigid_of_[b]]; }
  [[nodiscard]] const BodyRecord<Real>& record(std::size_t b) const { return rigid_[rigid_of_[b]]; }
  /// Sphere k of a body that is not lone.
  [[nodiscard]] const MemberRecord& member(std::size_t b, std::size_t k) const {
    return members_[first_member_[rigid_of_[b]] + k];
  }

  /// Puts the members of a clump or fixed body where its body record says.
  void place_members(std::size_t b) {
    const BodyRecord<Real>& body = record(b);
    const Axes<double> axes = axes_of(body.orientation);
    const Vec3<double> w = axes.to_space(body.angular_velocity.template as<double>());
    for (std::size_t s = first_[b]; s < first_[b + 1]; ++s) {
      const Placed<double> at = placed(member(b, s - first_[b]).offset, axes, w, 0.0);
      spheres_[s].position = body.position + at.arm;
      spheres_[s].velocity = body.velocity + at.velocity.template as<Real>();
      spheres_[s].angular_velocity = w.template as<Real>();
    }
  }

  /// Moves a body as a whole by `by`, with no change of its motion.
  void shift(std::size_t b, const Vector& by) {
    if (!is_lone(b)) {
      record(b).position += to_vec3(by);
    }
    for (std::size_t s = first_[b]; s < first_[b + 1]; ++s) {
      spheres_[s].position += to_vec3(by);
    }
  }

  /// Gives a body another motion; `w` in space.
  void set_motion(std::size_t b, const Vector& v, const Vector& w) {
    if (is_lone(b)) {
      spheres_[first_[b]].velocity = to_vec3<Real>(v);
      spheres_[first_[b]].angular_velocity = to_vec3<Real>(w);
    } else {
      record(b).velocity = to_vec3<Real>(v);
      record(b).angular_velocity = to_vec3<Real>(Vector(orientation(b).conjugate() * w));
      place_members(b);
    }
  }

  /// Makes a body immovable where it stands.
  void fix(std::size_t b) {
    if (is_lone(b)) {
      BodyRecord<Real> body;
      body.position = spheres_[first_[b]].position;
      body.mass = static_cast<Real>(mass(b));
      body.inertia = to_vec3<Real>(inertia(b));
      add_record(b) = body;
      members_.push_back({});
    }
    kinds_[b] = BodyKind::fixed;
    activities_[b] = Activity::resting;
    stop(b);
    for (std::size_t s = first_[b]; s < first_[b + 1]; ++s) {
      spheres_[s].inverse_mass = 0;
    }
  }
  /// Takes its motion from a body.
  void stop(std::size_t b) {
    if (!is_lone(b)) {
      record(b).velocity = record(b).angular_velocity = {};
    }
    for (std::size_t s = first_[b]; s < first_[b + 1]; ++s) {
      spheres_[s].velocity = spheres_[s].angular_velocity = {};
    }
  }

  /// All of it (core/archive.hpp).
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive(self.kinds_, self.activities_, self.ids_, self.materials_, self.solid_volumes_,
            self.bounding_radii_, self.mobilities_, self.first_, self.spheres_, self.forces_,
            self.held_forces_, self.rigid_of_, self.rigid_, self.first_member_, self.members_, self.body_of_,
            self.next_id_);
    if constexpr (Archive::reading) {
      if (!self.consistent()) {
        archive.fail("bodies and spheres do not belong together");
      }
    }
  }

  static constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();

  /// Keeps the bodies listed in `order`, in that order. Returns for each old sphere its new index, or `gone`.
  std::vector<std::uint32_t> rearrange(std::span<const std::uint32_t> order) {
    std::vector<std::uint32_t> moved_to(spheres_.size(), gone), kept, owners, first{0};
    std::vector<std::uint32_t> rigid, members, rigid_of, first_member;
    kept.reserve(spheres_.size());
    for (std::size_t place = 0; place < order.size(); ++place) {
      const std::uint32_t b = order[place];
      for (std::uint32_t s = first_[b]; s < first_[b + 1]; ++s) {
        moved_to[s] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(s);
        owners.push_back(static_cast<std::uint32_t>(place));
      }
      first.push_back(static_cast<std::uint32_t>(kept.size()));
      const std::uint32_t own = rigid_of_[b];
      rigid_of.push_back(own == none ? none : static_cast<std::uint32_t>(rigid.size()));
      if (own != none) {
        rigid.push_back(own);
        first_member.push_back(static_cast<std::uint32_t>(members.size()));
        for (std::uint32_t k = 0; k < first_[b + 1] - first_[b]; ++k) {
          members.push_back(first_member_[own] + k);
        }
      }
    }
    first_ = std::move(first);
    body_of_ = std::move(owners);
    rigid_of_ = std::move(rigid_of);
    first_member_ = std::move(first_member);
    // One array after the other: there is never more than one copy.
    const auto pick = [](auto& values, std::span<const std::uint32_t> from) {
      std::remove_reference_t<decltype(values)> picked;
      picked.reserve(from.size());
      for (const std::uint32_t k : from) {
        picked.push_back(values[k]);
      }
      values = std::move(picked);
    };
    pick(kinds_, order);
    pick(activities_, order);
    pick(ids_, order);
    pick(materials_, order);
    pick(solid_volumes_, order);
    pick(bounding_radii_, order);
    pick(mobilities_, order);
    pick(spheres_, kept);
    pick(forces_, kept);
    if (!held_forces_.empty()) {
      pick(held_forces_, kept);
    }
    pick(rigid_, rigid);
    pick(members_, members);
    return moved_to;
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Whether all that is read of a body is there.
  [[nodiscard]] bool consistent() const {
    const std::size_t n = size(), spheres = spheres_.size(), rigid = rigid_.size();
    bool well = activities_.size() == n && ids_.size() == n && materials_.size() == n &&
                solid_volumes_.size() == n && bounding_radii_.size() == n && mobilities_.size() == n &&
                rigid_of_.size() == n && first_.size() == n + 1 && first_.front() == 0 &&
                first_.back() == spheres && forces_.size() == spheres &&
                (held_forces_.empty() || held_forces_.size() == spheres) && body_of_.size() == spheres &&
                first_member_.size() == rigid;
    for (std::size_t b = 0; well && b < n; ++b) {
      well = kinds_[b] <= BodyKind::fixed && activities_[b] <= Activity::resting &&
             first_[b] < first_[b + 1] && ids_[b] < next_id_ &&
             (is_lone(b) ? first_[b + 1] - first_[b] == 1
                         : rigid_of_[b] < rigid &&
                               first_member_[rigid_of_[b]] + (first_[b + 1] - first_[b]) <= members_.size());
      for (std::size_t s = first_[b]; well && s < first_[b + 1]; ++s) {
        well = s < spheres && body_of_[s] == b;
      }
    }
    return well;
  }

  [[nodiscard]] bool is_lone(std::size_t b) const { return kinds_[b] == BodyKind::lone; }

  /// An empty one; the members are to follow.
  BodyRecord<Real>& add_record(std::size_t b) {
    rigid_of_[b] = static_cast<std::uint32_t>(rigid_.size());
    first_member_.push_back(static_cast<std::uint32_t>(members_.size()));
    return rigid_.emplace_back();
  }

  std::vector<BodyKind> kinds_;
  std::vector<Activity> activities_;
  std::vector<std::uint64_t> ids_;
  std::vector<std::uint16_t> materials_;
  std::vector<double> solid_volumes_;
  std::vector<double> bounding_radii_;
  std::vector<double> mobilities_;
  std::vector<std::uint32_t> first_{0};

  std::vector<SphereRecord<Real>> spheres_;
  std::vector<ForceRecord<Real>> forces_, held_forces_;

  // Of bodies that are not lone: a lone sphere's own record holds all.
  std::vector<std::uint32_t> rigid_of_; // number of the body's record, or none
  std::vector<BodyRecord<Real>> rigid_;
  std::vector<std::uint32_t> first_member_; // of the body with that record
  std::vector<MemberRecord> members_;
  std::vector<std::uint32_t> body_of_;
  std::uint64_t next_id_ = 0;
};

} // namespace scree
