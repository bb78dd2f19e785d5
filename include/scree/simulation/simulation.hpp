#pragma once
/// \file
/// The simulation type: one model, its state and its time step.

#include "scree/packing/packing.hpp"
#include "scree/simulation/model.hpp"
#include "scree/simulation/motion_loop.hpp"
#include "scree/simulation/pair_loop.hpp"
#include "scree/simulation/spatial_order.hpp"
#include "scree/simulation/stable_step.hpp"
#include "scree/simulation/wall_contacts.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace scree {

/// A contact as observers see it. `second` is the number of a body, or of a wall where `with_wall` is set.
struct ContactView {
  std::size_t first, second;
  bool with_wall;
  Vector point;          ///< m
  Vector normal;         ///< unit vector from the second to the first
  double overlap;        ///< m
  Vector force;          ///< N, on the first
  double elastic_energy; ///< J, in its springs
};

/// Seconds of wall time spent in the parts of the time step.
struct StepTimes {
  double search = 0.0, forces = 0.0, motion = 0.0, walls = 0.0;
};

/// Grains, walls and the laws between them, as `Model` composes them (simulation/model.hpp).
///
///     scree::Simulation<> simulation{{.gravity = {0, 0, -9.81}}};
///     const auto rock = simulation.add_material({.normal_stiffness = 1e6, .shear_stiffness = 1e6});
///     simulation.add_wall({.name = "floor", .surfaces = {{scree::Plane{}, rock}}, .dynamics =
///     scree::Fixed{}}); simulation.add({.clump = &ball, .density = 2650, .material = rock, .position = {0,
///     0, 1}}); scree::run_for(simulation, 1.0);
///
/// Same input, same bits, for any number of threads and any neighbour search.
template <class Model = DefaultModel>
class Simulation {
  static_assert(detail::ModelCheck<Model>::holds);

public:
  using Real = typename Model::Real;
  using Law = typename Model::Contact;
  using AnyDynamics = typename Model::Walls::Any;
  using WallBody = Wall<AnyDynamics>;
  using WallContactRecord = WallContact<Real, Law::history_size>;

  /// \throws Error for a field of the setup out of its range.
  explicit Simulation(Setup<Model> setup = {})
      : setup_{std::move(setup)},
        materials_{setup_.stiffness},
        domain_{setup_.period},
        workers_{setup_.threads} {
    require("local_damping", setup_.local_damping, {0.0, 0.999});
    require("step_safety", setup_.step_safety, {1e-6, 1.0});
    require("time_step", setup_.time_step, {0.0, std::numeric_limits<double>::max(), "s"});
    require_positive("top_speed", setup_.top_speed, "m/s");
    if (!setup_.gravity.allFinite()) {
      throw Error("gravity must be finite");
    }
  }

  // ---- building
  // ------------------------------------------------------------------------------------------------

  MaterialId add_material(Material material) {
    const MaterialId id = materials_.add(std::move(material));
    materials_changed();
    return id;
  }
  void set_pair(MaterialId a, MaterialId b, const PairOverride& given) {
    materials_.set_pair(a, b, given);
    materials_changed();
  }

  /// What may be said of a body; the density is that of its material.
  struct BodySetup {
    const Clump* clump = nullptr;
    MaterialId material = 0;
    Vector position = Vector::Zero();                ///< m
    Quaternion orientation = Quaternion::Identity(); ///< principal axes to space
    Vector velocity = Vector::Zero();                ///< m/s
    Vector angular_velocity = Vector::Zero();        ///< rad/s, in space
    double scale = 1.0;                              ///< above 0
    bool fixed = false;
  };
  /// Adds one body and returns its id.
  std::uint64_t add(const BodySetup& b) {
    if (b.clump == nullptr) {
      throw Error("a body needs a clump for its shape");
    }
    lists_valid_ = false;
    limit_known_ = false;
    return bodies_.add({b.clump, b.scale, materials_.at(b.material).density, b.material, b.position,
                        b.orientation, b.velocity, b.angular_velocity, b.fixed});
  }
  /// Adds all bodies of a packing.
  void add(const Packing& packing) {
    for (const PackedBody& b : packing.bodies) {
      add(BodySetup{&packing.shapes.at(b.shape), b.material, b.position, b.orientation, b.velocity,
                    b.angular_velocity, b.scale, b.fixed});
    }
  }

  /// Adds a wall body and returns its number.
  /// \throws Error for a surface of an unknown material.
  std::size_t add_wall(WallBody wall) {
    for (const WallSurface& surface : wall.surfaces) {
      (void)materials_.at(surface.material());
    }
    wall.motion.orientation.normalize();
    walls_.push_back(std::move(wall));
    double extent = 0.0;
    for (const WallSurface& surface : walls_.back().surfaces) {
      extent = std::max(extent, surface.extent());
    }
    wall_extents_.push_back(extent);
    lists_valid_ = false;
    limit_known_ = false;
    if (started_) {
      start_wall(walls_.back());
    }
    return walls_.size() - 1;
  }

  // ---- changing
  // ------------------------------------------------------------------------------------------------

  /// Removes the bodies for which `gone(bodies, b)` is true and returns how many there were.
  template <class Predicate>
  std::size_t remove_bodies(Predicate gone) {
    std::vector<std::uint32_t> kept;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!gone(std::as_const(bodies_), b)) {
        kept.push_back(static_cast<std::uint32_t>(b));
      }
    }
    const std::size_t removed = bodies_.size() - kept.size();
    if (removed > 0) {
      rearrange(kept);
    }
    return removed;
  }
  /// Makes the bodies for which `held(bodies, b)` is true immovable and returns how many were free before.
  template <class Predicate>
  std::size_t fix_bodies(Predicate held) {
    std::size_t count = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!bodies_.is_fixed(b) && held(std::as_const(bodies_), b)) {
        bodies_.fix(b);
        ++count;
      }
    }
    lists_valid_ = lists_valid_ && count == 0;
    return count;
  }
  /// Gives body `b` another motion; `w` in space.
  void set_motion(std::size_t b, const Vector& v, const Vector& w) { bodies_.set_motion(b, v, w); }
  void set_gravity(const Vector& gravity) { setup_.gravity = gravity; }
  /// \throws Error outside [0, 0.999].
  void set_local_damping(double alpha) {
    setup_.local_damping = require("local_damping", alpha, {0.0, 0.999});
  }
  /// Changes what a material is made of, for bodies and walls alike; the density of bodies already there
  /// stays.
  void change_material(MaterialId id, const Material& material) {
    materials_.replace(id, material);
    materials_changed();
  }

  // ---- the time step
  // -------------------------------------------------------------------------------------------

  /// Advances everything by one time step.
  /// \throws Error for a time step above the stable one, a law that lacks a material's constant, or a body
  /// whose position or velocity is not a number.
  void step() {
    if (!started_) {
      start();
    }
    if (!limit_known_) {
      check_step();
    }
    const auto t0 = Clock::now();
    if (!lists_valid_ || lists_outlived() || sort_due()) {
      renew_lists();
    }
    const auto t1 = Clock::now();
    // Velocities given at the start stand at the step itself; the first kick takes them half a step on.
    const TimeStep now{time_, dt_, half_kick_ ? 0.5 * dt_ : dt_, setup_.gravity};
    workers_.for_each(blocks_.size(), [&](std::size_t b) { compute_forces(b); });
    const auto t2 = Clock::now();
    workers_.for_each(blocks_.size(), [&](std::size_t b) { move(b, now); });
    const auto t3 = Clock::now();
    gather(now);
    for (WallBody& wall : walls_) {
      std::visit([&](auto& dynamics) { dynamics.advance(wall.motion, wall.load, now); }, wall.dynamics);
    }
    note_wall_travel();
    half_kick_ = false;
    ++steps_;
    time_ = start_time_ + static_cast<double>(steps_ - start_steps_) * dt_;
    const auto t4 = Clock::now();
    const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
    times_.search += seconds(t0, t1);
    times_.forces += seconds(t1, t2);
    times_.motion += seconds(t2, t3);
    times_.walls += seconds(t3, t4);
  }

  /// s; the one given, or the stable one.
  /// \throws Error as `step` does.
  double time_step() {
    if (!limit_known_) {
      check_step();
    }
    return dt_;
  }
  /// The critical time step of what is there now and the pair or rope that sets it.
  [[nodiscard]] StepLimit step_limit() const {
    std::vector<Softest> softest_of(materials_.size());
    for (std::size_t m = 0; m < softest_of.size(); ++m) {
      softest_of[m] = softest(bodies_, static_cast<MaterialId>(m));
    }
    StepLimit limit;
    limit_by_pairs(softest_of, limit);
    limit_by_walls(softest_of, limit);
    return limit;
  }

  // ---- observing
  // -----------------------------------------------------------------------------------------------

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] std::size_t steps() const { return steps_; }
  [[nodiscard]] const Setup<Model>& setup() const { return setup_; }
  [[nodiscard]] const Bodies<Real>& bodies() const { return bodies_; }
  [[nodiscard]] const MaterialTable& materials() const { return materials_; }
  [[nodiscard]] const Law& law() const { return setup_.contact; }
  [[nodiscard]] std::span<const WallBody> walls() const { return walls_; }
  [[nodiscard]] const WallBody& wall(std::size_t w) const { return walls_.at(w); }
  /// The dynamics of wall `w`, which must be of kind `D`.
  template <class D>
  [[nodiscard]] const D& dynamics(std::size_t w) const {
    return std::get<D>(walls_.at(w).dynamics);
  }
  template <class D>
  [[nodiscard]] D& dynamics(std::size_t w) {
    return std::get<D>(walls_.at(w).dynamics);
  }
  [[nodiscard]] const Dissipation& dissipation() const { return lost_; }
  [[nodiscard]] const StepTimes& times() const { return times_; }
  [[nodiscard]] std::size_t list_renewals() const { return renewals_; }
  /// Pairs on the list, touching or not.
  [[nodiscard]] std::size_t listed_pairs() const { return pairs_.size(); }

  /// Calls `visit(const ContactView&)` for every contact, in a fixed order, as the law gives it for the
  /// present positions. Changes nothing.
  template <class Visit>
  void visit_contacts(Visit visit) const {
    for (std::size_t i = 0; i < pairs_.row_count(); ++i) {
      for (std::size_t pair = pairs_.begin_of(i); pair < pairs_.begin_of(i + 1); ++pair) {
        visit_pair(i, pair, visit);
      }
    }
    for (const auto& block : wall_blocks_) {
      for (const auto& c : block.contacts) {
        const auto& sphere = bodies_.spheres()[c.sphere];
        const MaterialId of = walls_[c.wall].surfaces[c.surface].material();
        const double energy = energy_of(materials_.pair(static_cast<MaterialId>(sphere.material), of),
                                        sphere.radius, c.overlap, c.history);
        visit(ContactView{bodies_.body_of(c.sphere), c.wall, true, c.point, c.normal, c.overlap, c.force,
                          energy});
      }
    }
  }

private:
  using Clock = std::chrono::steady_clock;

  // ---- start and stable step
  // -----------------------------------------------------------------------------------

  void start() {
    check_step();
    started_ = true;
    for (WallBody& wall : walls_) {
      start_wall(wall);
    }
  }

  void start_wall(WallBody& wall) {
    const TimeStep now{time_, time_step(), dt_, setup_.gravity};
    std::visit([&](auto& dynamics) { dynamics.start(wall.motion, now); }, wall.dynamics);
    lists_valid_ = false;
  }

  void materials_changed() {
    const std::size_t n = materials_.size();
    pair_materials_.assign(n * n, {});
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        pair_materials_[a * n + b] =
            materials_.pair(static_cast<MaterialId>(a), static_cast<MaterialId>(b)).template as<Real>();
      }
    }
    limit_known_ = false;
  }

  void check_step() {
    const StepLimit limit = step_limit();
    const double stable = setup_.step_safety * limit.critical;
    double dt = setup_.time_step;
    if (dt == 0.0) {
      // Once running, a step stays as it is while it is stable.
      dt = started_ && dt_ <= stable ? dt_ : stable;
      if (std::isinf(dt)) {
        throw Error("time_step: nothing here sets a stable one (no free bodies, no ropes); give one");
      }
    }
    if (dt > stable) {
      throw Error(message("time_step = ", dt, " s is above the stable ", stable, " s (", setup_.step_safety,
                          " of the critical ", limit.critical, " s), set by ", limit.cause));
    }
    if (dt != dt_) {
      start_time_ = time_;
      start_steps_ = steps_;
      dt_ = dt;
    }
    limit_known_ = true;
  }

  void limit_by_pairs(std::span<const Softest> softest_of, StepLimit& limit) const {
    const std::size_t n = materials_.size();
    std::vector<bool> on_wall(n, false);
    for (const WallBody& wall : walls_) {
      for (const WallSurface& surface : wall.surfaces) {
        on_wall[surface.material()] = true;
      }
    }
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        const Softest &p = softest_of[a], &q = softest_of[b];
        if (p.mobility == 0.0) {
          continue;
        }
        const auto name = [&](std::size_t m) { return materials_.at(static_cast<MaterialId>(m)).name; };
        if (b >= a && q.mobility > 0.0) {
          const double radius = p.radius * q.radius / (p.radius + q.radius);
          const double mass = p.mass * q.mass / (p.mass + q.mass);
          limit_by_contact(limit, a, b, radius, mass, p.mobility + q.mobility, [&] {
            return message("a contact of body ", p.body, " ('", name(a), "', ", p.mass, " kg) with body ",
                           q.body, " ('", name(b), "', ", q.mass, " kg)");
          });
        }
        if (on_wall[b]) {
          limit_by_contact(limit, a, b, p.radius, p.mass, p.mobility, [&] {
            return message("a contact of body ", p.body, " ('", name(a), "', ", p.mass,
                           " kg) with a wall of '", name(b), "'");
          });
        }
      }
    }
  }

  void limit_by_contact(StepLimit& limit, std::size_t a, std::size_t b, double radius, double mass,
                        double mobility, const auto& who) const {
    const auto pair = materials_.pair(static_cast<MaterialId>(a), static_cast<MaterialId>(b));
    const std::string names = message("'", materials_.at(static_cast<MaterialId>(a)).name, "' and '",
                                      materials_.at(static_cast<MaterialId>(b)).name, "'");
    setup_.contact.check(pair, names);
    const ContactStiffness k = setup_.contact.stiffness(pair, radius, mass, setup_.top_speed);
    const double stiffest = std::max(k.normal, k.shear);
    const double rate_ratio =
        stiffest > 0.0
            ? 0.5 * std::max(pair.normal_damping_rate, pair.shear_damping_rate) * std::sqrt(mass / stiffest)
            : 0.0;
    limit.lower_to(critical_step(crowding * stiffest * mobility, pair.damping_ratio + rate_ratio),
                   [&] { return message(who(), " of ", stiffest, " N/m"); });
  }

  void limit_by_walls(std::span<const Softest> softest_of, StepLimit& limit) const {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      std::visit(
          [&](const auto& dynamics) {
            using D = std::decay_t<decltype(dynamics)>;
            double squared_frequency = 0.0;
            std::string cause;
            if constexpr (IsHeld<D>) {
              squared_frequency += dynamics.squared_frequency();
              cause = dynamics.holder();
            }
            if constexpr (GivesWay<D>) {
              if (const std::size_t touching = walls_[w].load.contacts; touching > 0) {
                const double arm = std::isfinite(wall_extents_[w]) ? wall_extents_[w] : 0.0;
                squared_frequency += static_cast<double>(touching) * stiffest_on(walls_[w], softest_of) *
                                     dynamics.mobility(arm);
                cause += message(cause.empty() ? "" : " and ", touching, " contacts of grains");
              }
            }
            if (squared_frequency > 0.0) {
              limit.lower_to(critical_step(squared_frequency, 0.0),
                             [&] { return message("wall '", walls_[w].name, "': ", cause); });
            }
          },
          walls_[w].dynamics);
    }
  }

  [[nodiscard]] double stiffest_on(const WallBody& wall, std::span<const Softest> softest_of) const {
    double most = 0.0;
    for (const WallSurface& surface : wall.surfaces) {
      for (std::size_t m = 0; m < materials_.size(); ++m) {
        const Softest& body = softest_of[m];
        if (body.mobility > 0.0) {
          const auto pair = materials_.pair(static_cast<MaterialId>(m), surface.material());
          const ContactStiffness k = setup_.contact.stiffness(pair, body.radius, body.mass, setup_.top_speed);
          most = std::max({most, k.normal, k.shear});
        }
      }
    }
    return most;
  }

  // ---- neighbour lists
  // -----------------------------------------------------------------------------------------

  [[nodiscard]] bool sort_due() const {
    return setup_.sort_interval > 0 && steps_ % setup_.sort_interval == 0 && steps_ != sorted_at_;
  }

  /// Whether something may have closed the gap that the lists allow for.
  bool lists_outlived() {
    const auto over = [this] { return 2.0 * travel_ > skin_ || travel_ + wall_travel_ > skin_; };
    if (skin_ == 0.0) {
      return true;
    }
    if (!over()) {
      return false;
    }
    // The sum of the largest speeds overstates how far any one sphere has come: look.
    double most2 = 0.0;
    const auto spheres = std::as_const(bodies_).spheres();
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      most2 = std::max(most2, squared_norm(spheres[s].position - listed_at_[s]));
    }
    travel_ = std::sqrt(most2) * 1.25; // ours: leaves a few steps before the next look
    return over();
  }

  void renew_lists() {
    check_positions();
    if (domain_.periodic()) {
      domain_.wrap(bodies_);
    }
    if (sort_due() || sorted_at_ == never) {
      if (setup_.sort_interval > 0) {
        rearrange(spatial_order(bodies_));
      }
      sorted_at_ = steps_;
    }
    if (bodies_.sphere_count() > Partner::most) {
      throw Error(message("bodies: ", bodies_.sphere_count(), " spheres are more than the ", Partner::most,
                          " that one simulation holds"));
    }
    const auto spheres = std::as_const(bodies_).spheres();
    balls_.resize(spheres.size());
    double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      balls_[s] = {spheres[s].position, spheres[s].radius};
      smallest = std::min(smallest, spheres[s].radius);
      largest = std::max(largest, spheres[s].radius);
    }
    skin_ = balls_.empty() ? 0.0 : setup_.neighbours.skin(smallest);
    domain_.add_images(balls_, 2.0 * largest + skin_, images_);
    setup_.neighbours.find(balls_, spheres.size(), skin_, workers_, candidates_);
    pairs_.renew(spheres.size(), workers_, [&](std::size_t i, std::vector<Partner>& row) {
      for (const std::uint32_t k : candidates_.row(i)) {
        append_partner(i, k, row);
      }
    });
    blocks_ = divided(bodies_, pairs_, slot_count_);
    slots_.resize(slot_count_);
    renew_wall_lists();
    listed_at_.resize(spheres.size());
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      listed_at_[s] = spheres[s].position;
    }
    travel_ = wall_travel_ = 0.0;
    lists_valid_ = true;
    ++renewals_;
    if (walls_give_way()) {
      check_step(); // a body among many grains is held more stiffly than at the start
    }
  }

  void append_partner(std::size_t i, std::uint32_t k, std::vector<Partner>& row) const {
    const std::size_t owned = bodies_.sphere_count();
    const bool image = k >= owned;
    const std::uint32_t j = image ? images_[k - owned].owner : k;
    const auto spheres = bodies_.spheres();
    const bool both_fixed = !(spheres[i].inverse_mass > 0) && !(spheres[j].inverse_mass > 0);
    if (j > i && bodies_.body_of(i) != bodies_.body_of(j) && !both_fixed) {
      row.push_back({j & Partner::most, image ? images_[k - owned].image & 31U : Partner::here});
    }
  }

  void renew_wall_lists() {
    // The contacts of all blocks, in the order of the spheres, are dealt out to the new blocks.
    std::vector<WallContactRecord> contacts;
    for (const auto& block : wall_blocks_) {
      contacts.insert(contacts.end(), block.contacts.begin(), block.contacts.end());
    }
    wall_blocks_.resize(blocks_.size());
    block_results_.resize(blocks_.size());
    workers_.for_each(blocks_.size(), [&](std::size_t b) {
      find_wall_candidates(blocks_[b], bodies_, std::span<const WallBody>{walls_}, skin_, wall_blocks_[b]);
      const auto lower = [](const WallContactRecord& c, std::size_t s) { return c.sphere < s; };
      wall_blocks_[b].contacts.assign(
          std::lower_bound(contacts.begin(), contacts.end(), blocks_[b].first_sphere, lower),
          std::lower_bound(contacts.begin(), contacts.end(), blocks_[b].end_sphere, lower));
      block_results_[b].walls.resize(walls_.size());
    });
  }

  /// Puts the bodies of `order` in that order and drops the others; histories follow.
  void rearrange(std::span<const std::uint32_t> order) {
    const std::vector<std::uint32_t> moved_to = bodies_.rearrange(order);
    if (pairs_.row_count() <= moved_to.size()) {
      pairs_.rearrange(moved_to, bodies_.sphere_count(), Law::history_parity, workers_);
    }
    std::vector<WallContactRecord> contacts;
    for (auto& block : wall_blocks_) {
      for (auto& contact : block.contacts) {
        contact.sphere = moved_to[contact.sphere];
        if (contact.sphere != Bodies<Real>::gone) {
          contacts.push_back(contact);
        }
      }
      block.contacts.clear();
    }
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const auto& a, const auto& b) { return a.key() < b.key(); });
    if (!wall_blocks_.empty()) {
      wall_blocks_.front().contacts = std::move(contacts);
    }
    lists_valid_ = false;
    limit_known_ = false;
  }

  void check_positions() const {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      // Beyond this a cell number would overflow; nothing that scree is for is that large.
      if (const Vector x = bodies_.position(b); !(x.cwiseAbs().maxCoeff() < 1e9)) {
        throw Error(message("body ", bodies_.id(b), " has left the domain at t = ", time_, " s: position (",
                            x.x(), ", ", x.y(), ", ", x.z(), ") m"));
      }
    }
  }

  void note_wall_travel() {
    double most = 0.0;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      const WallMotion& m = walls_[w].motion;
      const double spin = m.angular_velocity.norm();
      most = std::max(most, m.velocity.norm() + (spin > 0.0 ? spin * wall_extents_[w] : 0.0));
    }
    wall_travel_ += most * dt_;
  }

  [[nodiscard]] bool walls_give_way() const {
    return std::any_of(walls_.begin(), walls_.end(), [](const WallBody& wall) {
      return std::visit([](const auto& d) { return GivesWay<std::decay_t<decltype(d)>>; }, wall.dynamics);
    });
  }

  // ---- forces and motion
  // ---------------------------------------------------------------------------------------

  struct BlockResult {
    std::vector<WallSum> walls;
    Dissipation lost;
    double fastest = 0.0;
  };

  [[nodiscard]] auto pair_material() const {
    return [table = pair_materials_.data(), n = materials_.size()](
               std::uint32_t a, std::uint32_t b) -> const PairMaterial<Real>& { return table[a * n + b]; };
  }

  void compute_forces(std::size_t b) {
    const Block& block = blocks_[b];
    BlockResult& result = block_results_[b];
    const auto forces = bodies_.forces().subspan(block.first_sphere, block.end_sphere - block.first_sphere);
    std::fill(forces.begin(), forces.end(), ForceRecord<Real>{});
    std::fill(result.walls.begin(), result.walls.end(), WallSum{});
    result.lost = {};
    const auto dt = static_cast<Real>(dt_);
    const std::span<ForceRecord<Real>> slots{slots_};
    if (domain_.periodic()) {
      add_pair_forces<true, Model::energy_audit>(block, setup_.contact, pair_material(), domain_, dt, bodies_,
                                                 pairs_, slots, result.lost);
    } else {
      add_pair_forces<false, Model::energy_audit>(block, setup_.contact, pair_material(), domain_, dt,
                                                  bodies_, pairs_, slots, result.lost);
    }
    add_wall_forces<Model::energy_audit>(setup_.contact, pair_material(), std::span<const WallBody>{walls_},
                                         dt, bodies_, wall_blocks_[b], std::span<WallSum>{result.walls},
                                         result.lost);
  }

  void move(std::size_t b, const TimeStep& now) {
    fetch_forces(blocks_[b], std::span<const ForceRecord<Real>>{slots_}, bodies_);
    block_results_[b].fastest = move_bodies<typename Model::Integrator, Model::energy_audit>(
        blocks_[b], now, setup_.local_damping, bodies_, block_results_[b].lost);
  }

  /// Sums what the blocks found, in their order.
  void gather(const TimeStep& now) {
    for (WallBody& wall : walls_) {
      wall.load.force.setZero();
      wall.load.moment.setZero();
      wall.load.contacts = 0;
    }
    double fastest = 0.0;
    for (const BlockResult& result : block_results_) {
      for (std::size_t w = 0; w < walls_.size(); ++w) {
        walls_[w].load.force += result.walls[w].force;
        walls_[w].load.moment += result.walls[w].moment;
        walls_[w].load.contacts += result.walls[w].contacts;
      }
      lost_ += result.lost;
      if (!std::isfinite(result.fastest)) {
        report_runaway();
      }
      fastest = std::max(fastest, result.fastest);
    }
    for (WallBody& wall : walls_) {
      wall.load.impulse += wall.load.force * now.kick;
      wall.load.angular_impulse += wall.load.moment * now.kick;
      wall.load.work -=
          (wall.load.force.dot(wall.motion.velocity) + wall.load.moment.dot(wall.motion.angular_velocity)) *
          dt_;
    }
    // A hair more, for the arc that a turning member sphere takes.
    travel_ += fastest * dt_ * 1.01;
  }

  [[noreturn]] void report_runaway() const {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!bodies_.velocity(b).allFinite() || !bodies_.angular_velocity(b).allFinite()) {
        throw Error(message("body ", bodies_.id(b), " has a velocity that is not a number at t = ", time_,
                            " s: a time step too long, an initial overlap or a stiffness out of proportion"));
      }
    }
    throw Error(message("a velocity is not a number at t = ", time_, " s"));
  }

  // ---- observing
  // -----------------------------------------------------------------------------------------------

  template <class History>
  [[nodiscard]] double energy_of(const PairMaterial<double>& pair, double reduced_radius, double overlap,
                                 const History& history) const {
    std::array<double, static_cast<std::size_t>(Law::history_size)> h{};
    std::copy(history.begin(), history.end(), h.begin());
    return setup_.contact.elastic_energy(pair, reduced_radius, overlap, h);
  }

  template <class Visit>
  void visit_pair(std::size_t i, std::size_t pair, Visit& visit) const {
    const Partner partner = pairs_.partner(pair);
    const auto &own = bodies_.spheres()[i], &other = bodies_.spheres()[partner.sphere];
    const Vec3<double> apart = own.position - other.position - domain_.shift(partner.image);
    const double d2 = squared_norm(apart), reach = own.radius + other.radius;
    if (d2 >= reach * reach) {
      return;
    }
    const Touch<Real> touch = touch_of(own, other, apart, d2, Real{0});
    auto history = pairs_.history(pair);
    const auto& constants = pair_material()(own.material, other.material);
    const ContactForce<Real> f = setup_.contact.evaluate(constants, touch.kinematics, history);
    const Vector normal = to_eigen(touch.kinematics.normal);
    const double energy =
        energy_of(constants.template as<double>(), static_cast<double>(touch.kinematics.reduced_radius),
                  static_cast<double>(touch.kinematics.overlap), history);
    visit(ContactView{bodies_.body_of(i), bodies_.body_of(partner.sphere), false,
                      to_eigen(own.position) - static_cast<double>(touch.arm_i) * normal, normal,
                      static_cast<double>(touch.kinematics.overlap),
                      to_eigen(touch.kinematics.normal * f.normal + f.tangential), energy});
  }

  static constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

  Setup<Model> setup_;
  MaterialTable materials_;
  std::vector<PairMaterial<Real>> pair_materials_;
  Domain domain_;
  Workers workers_;

  Bodies<Real> bodies_;
  PairList<Real, Law::history_size> pairs_;
  std::vector<WallBody> walls_;
  std::vector<double> wall_extents_;

  std::vector<Ball> balls_;
  std::vector<Domain::Image> images_;
  CandidateRows candidates_;
  std::vector<Block> blocks_;
  std::vector<WallBlock<Real, Law::history_size>> wall_blocks_;
  std::vector<BlockResult> block_results_;
  std::vector<ForceRecord<Real>> slots_;
  std::size_t slot_count_ = 0;
  std::vector<Vec3<double>> listed_at_;
  double skin_ = 0.0, travel_ = 0.0, wall_travel_ = 0.0;
  bool lists_valid_ = false;
  std::size_t sorted_at_ = never, renewals_ = 0;

  double time_ = 0.0, start_time_ = 0.0, dt_ = 0.0;
  std::size_t steps_ = 0, start_steps_ = 0;
  bool started_ = false, half_kick_ = true, limit_known_ = false;
  Dissipation lost_;
  StepTimes times_;
};

} // namespace scree
