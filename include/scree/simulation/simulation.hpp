#pragma once
/// \file
/// The simulation type: one model, its state and its time step.

#include "scree/core/archive.hpp"
#include "scree/packing/packing.hpp"
#include "scree/simulation/change_over.hpp"
#include "scree/simulation/contact_lists.hpp"
#include "scree/simulation/contact_view.hpp"
#include "scree/simulation/gates.hpp"
#include "scree/simulation/model.hpp"
#include "scree/simulation/motion_loop.hpp"
#include "scree/simulation/pair_loop.hpp"
#include "scree/simulation/resting.hpp"
#include "scree/simulation/runaway.hpp"
#include "scree/simulation/step_limit.hpp"
#include "scree/simulation/step_times.hpp"
#include "scree/simulation/wall_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace scree {

/// Grains, walls and the laws between them, as `Model` composes them (simulation/model.hpp).
///
///     scree::Simulation<> simulation{{.gravity = {0, 0, -9.81}}};
///     const auto rock = simulation.add_material({.normal_stiffness = 1e6, .shear_stiffness = 1e6});
///     simulation.add_wall(
///         {.name = "floor", .surfaces = {{scree::Plane{}, rock}}, .dynamics = scree::Fixed{}});
///     simulation.add({.clump = &ball, .material = rock, .position = {0, 0, 1}});
///     scree::run_for(simulation, 1.0);
///
/// Same input, same bits, for any number of threads and any neighbour search.
///
/// A simulation type takes its time to compile. Where several sources use one, a header of theirs says
/// `extern template class scree::Simulation<Model>;` and one source `template class
/// scree::Simulation<Model>;`.
template <class Model = DefaultModel>
class Simulation {
  static_assert(detail::ModelCheck<Model>::holds);

public:
  using Real = typename Model::Real;
  using Law = typename Model::Contact;
  using AnyDynamics = typename Model::Walls::Any;
  using WallBody = Wall<AnyDynamics>;
  using Pairs = PairList<Real, Law::history_size>;
  using WallContactRecord = WallContact<Real, Law::history_size>;

  /// \throws Error for a field of the setup out of its range.
  explicit Simulation(Setup<Model> setup = {})
      : setup_{std::move(setup)},
        materials_{setup_.stiffness},
        domain_{setup_.period},
        workers_{setup_.threads},
        lists_{setup_.neighbours, setup_.sort_interval},
        rest_{setup_.rest} {
    require("local_damping", setup_.local_damping, {0.0, 0.999});
    require("step_safety", setup_.step_safety, {1e-6, 1.0});
    require("time_step", setup_.time_step, {0.0, std::numeric_limits<double>::max(), "s"});
    require_positive("top_speed", setup_.top_speed, "m/s");
    if (!setup_.gravity.allFinite()) {
      throw Error("gravity must be finite");
    }
  }

  // ---- building ----

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
  std::uint64_t add(const BodySetup& b);
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
    bodies_changed();
    if (started_) {
      start_wall(walls_.back());
    }
    return walls_.size() - 1;
  }

  // ---- changing ----

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
      lists_.rearrange(kept, bodies_, workers_);
      bodies_changed();
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
    if (count > 0) {
      bodies_changed();
    }
    return count;
  }
  /// Gives body `b` another motion; `w` in space.
  void set_motion(std::size_t b, const Vector& v, const Vector& w) {
    wake_all();
    bodies_.set_motion(b, v, w);
  }
  /// Hands wall `w` over to other dynamics, from where it is now on.
  void set_dynamics(std::size_t w, AnyDynamics dynamics) {
    walls_.at(w).dynamics = std::move(dynamics);
    limit_known_ = false;
    wake_all();
    if (started_) {
      start_wall(walls_[w]);
    }
  }
  void set_gravity(const Vector& gravity) {
    setup_.gravity = gravity;
    wake_all();
  }
  /// \throws Error outside [0, 0.999].
  void set_local_damping(double alpha) {
    setup_.local_damping = require("local_damping", alpha, {0.0, 0.999});
  }
  /// Changes what counts as rest, and wakes all.
  /// \throws Error for a field out of its range.
  void set_rest(const typename Model::Rest& rest) {
    wake_all();
    rest_.set_rule(rest);
    setup_.rest = rest;
  }
  /// Changes what a material is made of, for bodies and walls alike; the density of bodies already there
  /// stays.
  void change_material(MaterialId id, const Material& material) {
    materials_.replace(id, material);
    materials_changed();
  }

  // ---- the time step ----

  /// Advances everything by one time step.
  /// \throws Error for a time step above the stable one, a law that lacks a material's constant, or a body
  /// whose position or velocity is not a number.
  void step();

  /// s; the one given, or the stable one.
  /// \throws Error as `step` does.
  double time_step() {
    if (!limit_known_) {
      check_step();
    }
    return dt_;
  }
  /// The critical time step of what is there now and the pair or rope that sets it.
  [[nodiscard]] StepLimit step_limit() const;

  // ---- observing ----

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
  /// Free bodies that rest now (simulation/resting.hpp).
  [[nodiscard]] std::size_t resting_count() const { return rest_.count(); }
  [[nodiscard]] std::size_t list_renewals() const { return lists_.renewals(); }
  /// Pairs on the list, touching or not.
  [[nodiscard]] std::size_t listed_pairs() const { return lists_.pairs().size(); }

  /// Calls `visit(const ContactView&)` for every contact, in a fixed order, as the law gives it for the
  /// present positions. Changes nothing.
  template <class Visit>
  void visit_contacts(Visit visit) const {
    detail::ContactViewer viewer{setup_.contact, materials_, domain_, bodies_};
    viewer.visit_pairs(lists_.pairs(), lists_.histories(), visit);
    for (const auto& block : lists_.wall_blocks()) {
      viewer.visit_wall_contacts(block.contacts, walls(), visit);
    }
  }

  // ---- keeping ----

  /// All that later steps depend on: `archive(simulation)` writes it, or reads it into a simulation that was
  /// made as that one was (same setup, materials, walls with their surfaces, paths and ropes; no bodies
  /// needed). What follows is the same to the bit. See core/archive.hpp.
  /// \throws Error that says in what the two differ.
  template <class Self, class Archive>
  static void fields(Self& self, Archive& archive) {
    archive.section("simulation");
    self.check_alike(archive);
    archive(self.setup_.gravity, self.setup_.local_damping, self.materials_, self.bodies_);
    if constexpr (Model::Rest::rests) {
      archive(self.setup_.rest);
      if constexpr (Archive::reading) {
        self.rest_.set_rule(self.setup_.rest);
      }
    }
    for (auto& wall : self.walls_) {
      archive.section(wall.name);
      archive(wall);
    }
    archive(self.lists_, self.time_, self.start_time_, self.dt_, self.steps_, self.start_steps_,
            self.started_, self.half_kick_, self.limit_known_, self.lost_, self.times_, self.rest_);
    if constexpr (Archive::reading) {
      self.mix_materials();
      const auto spheres = std::as_const(self.bodies_).spheres();
      const bool made_of_known = std::all_of(spheres.begin(), spheres.end(), [&](const auto& sphere) {
        return sphere.material < self.materials_.size();
      });
      if (!made_of_known || !self.lists_.rebuild(self.domain_, self.bodies_, self.walls(), self.workers_)) {
        archive.fail("contacts, bodies and walls do not belong together");
      }
      self.make_room_for_results();
    }
  }

private:
  using Clock = StepTimes::Clock;

  /// \throws Error where a checkpoint is of another model or setup.
  template <class Archive>
  void check_alike(Archive& archive) const {
    archive.same("model", model_name<Model>());
    archive.same("size of a history", Law::history_size);
    archive.same("meaning of stiffness", static_cast<int>(setup_.stiffness));
    for (int d = 0; d < 3; ++d) {
      archive.same(message("period[", d, "]"), setup_.period[d]);
    }
    archive.same("time_step", setup_.time_step);
    archive.same("step_safety", setup_.step_safety);
    archive.same("top_speed", setup_.top_speed);
    archive.same("sort_interval", setup_.sort_interval);
    archive.same("number of materials", materials_.size());
    archive.same("number of walls", walls_.size());
    for (const WallBody& wall : walls_) {
      archive.same("name of a wall", wall.name);
      archive.same(message("number of surfaces of '", wall.name, "'"), wall.surfaces.size());
    }
  }

  // ---- start and stable step ----

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
    lists_.invalidate();
  }

  void bodies_changed() {
    wake_all();
    lists_.invalidate();
    limit_known_ = false;
  }

  void materials_changed() {
    wake_all();
    mix_materials();
    limit_known_ = false;
  }

  void mix_materials() {
    const std::size_t n = materials_.size();
    pair_materials_.assign(n * n, {});
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        pair_materials_[a * n + b] =
            materials_.pair(static_cast<MaterialId>(a), static_cast<MaterialId>(b)).template as<Real>();
      }
    }
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

  // ---- lists ----

  void keep_lists() {
    const bool renewed = lists_.keep_valid(steps_, time_, domain_, bodies_, walls_, workers_);
    if (renewed) {
      make_room_for_results();
      if (walls_give_way()) {
        check_step(); // a body among many grains is held more stiffly than at the start
      }
    }
    look_for_rest();
  }

  // ---- rest ----

  void wake_all() {
    if (rest_.count() > 0) {
      rest_.wake_all(bodies_);
      lists_.invalidate();
    }
  }

  void look_for_rest() {
    if constexpr (Model::Rest::rests) {
      if (!rest_.due(steps_) ||
          !rest_.look(steps_, dt_, setup_.gravity,
                      detail::disturbed_by_walls(lists_.wall_blocks(), walls(), bodies_), lists_.blocks(),
                      workers_, bodies_)) {
        return;
      }
      lost_.resting += rest_.taken();
      lists_.change_over(domain_, bodies_, workers_);
      detail::HeldForces held{setup_.contact, pair_material(), domain_, static_cast<Real>(dt_), bodies_};
      held.change(lists_.block_pairs(), lists_.pairs());
      rest_.changed_over(bodies_);
    }
  }

  void make_room_for_results() {
    block_results_.resize(lists_.blocks().size());
    for (BlockResult& result : block_results_) {
      result.walls.resize(walls_.size());
    }
  }

  /// m/s, that no point of any wall exceeds.
  [[nodiscard]] double wall_speed() const {
    double most = 0.0;
    for (const WallBody& wall : walls_) {
      const double spin = wall.motion.angular_velocity.norm();
      most = std::max(most, wall.motion.velocity.norm() + (spin > 0.0 ? spin * wall.extent() : 0.0));
    }
    return most;
  }

  [[nodiscard]] bool walls_give_way() const {
    return std::any_of(walls_.begin(), walls_.end(), [](const WallBody& wall) {
      return std::visit([](const auto& d) { return GivesWay<std::decay_t<decltype(d)>>; }, wall.dynamics);
    });
  }

  // ---- forces and motion ----

  struct BlockResult {
    std::vector<WallSum> walls;
    Dissipation lost;
    double fastest = 0.0;
    StepTimes spent; // by the thread that had it
  };

  [[nodiscard]] auto pair_material() const {
    return [table = pair_materials_.data(), n = materials_.size()](
               std::uint32_t a, std::uint32_t b) -> const PairMaterial<Real>& { return table[a * n + b]; };
  }

  /// \tparam images whether some pairs are with periodic images
  template <bool images>
  [[nodiscard]] auto pair_loop() {
    using Loop = detail::PairLoop<images, Model::energy_audit, KernelNumber<Law, Real>, Law, Real,
                                  decltype(pair_material())>;
    return Loop{setup_.contact, pair_material(), domain_, static_cast<Real>(dt_), bodies_};
  }

  [[nodiscard]] auto wall_loop() {
    using Loop = detail::WallLoop<Model::energy_audit, WallNumber<Law, Real>, Law, Real, WallBody,
                                  decltype(pair_material())>;
    return Loop{setup_.contact, pair_material(), walls_, static_cast<Real>(dt_), bodies_};
  }

  void compute_forces(std::size_t b) {
    const auto begin = Clock::now();
    BlockResult& result = block_results_[b];
    auto& pairs = lists_.block_pairs(b);
    begin_forces(b);
    std::fill(result.walls.begin(), result.walls.end(), WallSum{});
    result.lost = {};
    result.spent = {};
    if (is_left_alone(b)) {
      return;
    }
    pair_loop<false>().add_all(pairs.within, result.lost);
    const auto slots = lists_.slots(b);
    const std::size_t crossing = pairs.crossing.pack_count() * pairs.crossing.lanes;
    pair_loop<false>().add_to_first(pairs.crossing, slots.first(crossing), result.lost);
    if (pairs.wrapped.size() > 0) {
      pair_loop<true>().add_to_first(pairs.wrapped, slots.subspan(crossing), result.lost);
    }
    const auto at_walls = Clock::now();
    wall_loop().add_all(lists_.wall_block(b), result.walls, result.lost);
    result.spent.contact = StepTimes::seconds(begin, at_walls);
    result.spent.walls = StepTimes::seconds(at_walls, Clock::now());
  }

  /// Whether nothing in a block can change.
  [[nodiscard]] bool is_left_alone(std::size_t b) const {
    return Model::Rest::rests && rest_.count() > 0 && lists_.block_pairs()[b].touched.empty();
  }

  /// Sets the forces on a block to what is held.
  void begin_forces(std::size_t b) {
    const auto forces = bodies_.forces();
    const auto first = static_cast<std::ptrdiff_t>(lists_.blocks()[b].first_sphere);
    const auto end = static_cast<std::ptrdiff_t>(lists_.blocks()[b].end_sphere);
    if constexpr (Model::Rest::rests) {
      if (rest_.count() > 0) {
        const auto held = std::as_const(bodies_).held_forces();
        auto& pairs = lists_.block_pairs(b);
        if (!pairs.begun) {
          std::copy(held.begin() + first, held.begin() + end, forces.begin() + first);
          pairs.begun = true;
        } else {
          for (const std::uint32_t s : pairs.touched) {
            forces[s] = held[s];
          }
        }
        return;
      }
    }
    std::fill(forces.begin() + first, forces.begin() + end, ForceRecord<Real>{});
  }

  void move(std::size_t b, const TimeStep& now) {
    const auto begin = Clock::now();
    const Block& block = lists_.blocks()[b];
    BlockResult& result = block_results_[b];
    if (is_left_alone(b)) {
      result.fastest = 0.0;
      return;
    }
    fetch_forces(block, std::as_const(lists_).slots(), bodies_);
    result.fastest = move_bodies<typename Model::Integrator, Model::energy_audit>(
        block, now, setup_.local_damping, bodies_, result.lost);
    result.spent.motion = StepTimes::seconds(begin, Clock::now());
  }

  /// Deals the wall time of the loop over blocks [s] out by what the threads spent in its parts.
  void note_times(double loop) {
    StepTimes spent;
    for (const BlockResult& result : block_results_) {
      spent += result.spent;
    }
    if (spent.total() > 0.0) {
      times_ += spent.scaled(loop / spent.total());
    }
  }

  /// Sums what the blocks found, in their order. Returns the largest speed of a sphere [m/s].
  double gather(const TimeStep& now) {
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
        detail::report_runaway(bodies_, time_);
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
    return fastest;
  }

  Setup<Model> setup_;
  MaterialTable materials_;
  std::vector<PairMaterial<Real>> pair_materials_;
  Domain domain_;
  Workers workers_;

  Bodies<Real> bodies_;
  std::vector<WallBody> walls_;
  ContactLists<Real, Law, typename Model::Neighbours, WallBody, Model::Rest::rests> lists_;
  decltype(detail::keeper_of<Real>(typename Model::Rest{})) rest_;
  std::vector<BlockResult> block_results_;

  double time_ = 0.0, start_time_ = 0.0, dt_ = 0.0;
  std::size_t steps_ = 0, start_steps_ = 0;
  bool started_ = false, half_kick_ = true, limit_known_ = false;
  Dissipation lost_;
  detail::Gates gates_;
  StepTimes times_;
};

// Outside of the class and so not inline: nearly all that a compiler has to do for a simulation type.

template <class Model>
std::uint64_t Simulation<Model>::add(const BodySetup& b) {
  if (b.clump == nullptr) {
    throw Error("a body needs a clump for its shape");
  }
  bodies_changed();
  return bodies_.add({b.clump, b.scale, materials_.at(b.material).density, b.material, b.position,
                      b.orientation, b.velocity, b.angular_velocity, b.fixed});
}

template <class Model>
StepLimit Simulation<Model>::step_limit() const {
  return scree::step_limit(bodies_, walls(), materials_, setup_.contact, setup_.top_speed,
                           lists_.near_walls());
}

template <class Model>
void Simulation<Model>::step() {
  if (!started_) {
    start();
  }
  if (!limit_known_) {
    check_step();
  }
  const auto t0 = Clock::now();
  keep_lists();
  const auto t1 = Clock::now();
  // Velocities given at the start stand at the step itself; the first kick takes them half a step on.
  const TimeStep now{time_, dt_, half_kick_ ? 0.5 * dt_ : dt_, setup_.gravity};
  gates_.shut(lists_.blocks());
  workers_.for_each(lists_.blocks().size(), [&](std::size_t b) {
    compute_forces(b);
    gates_.done(b, lists_.blocks()[b], [&](std::size_t ready) { move(ready, now); });
  });
  const auto t2 = Clock::now();
  const double fastest = gather(now);
  for (WallBody& wall : walls_) {
    std::visit([&](auto& dynamics) { dynamics.advance(wall.motion, wall.load, now); }, wall.dynamics);
  }
  lists_.note_travel(fastest * dt_ * 1.01, wall_speed() * dt_); // 1 %: the arc of a turning member sphere
  half_kick_ = false;
  ++steps_;
  time_ = start_time_ + static_cast<double>(steps_ - start_steps_) * dt_;
  times_.search += StepTimes::seconds(t0, t1);
  note_times(StepTimes::seconds(t1, t2));
  times_.walls += StepTimes::seconds(t2, Clock::now());
}

} // namespace scree
