#pragma once
/// \file
/// The compile-time choice of physics: named slots in one struct.

#include "scree/contact/linear_spring.hpp"
#include "scree/integrators/leapfrog.hpp"
#include "scree/neighbours/cell_grid.hpp"
#include "scree/neighbours/verlet_list.hpp"
#include "scree/simulation/resting.hpp"
#include "scree/walls/fixed.hpp"
#include "scree/walls/force_controlled.hpp"
#include "scree/walls/prescribed.hpp"
#include "scree/walls/rope_coupled.hpp"
#include "scree/walls/wall.hpp"

#include <boost/type_index.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <string>
#include <type_traits>

namespace scree {

/// What a model takes where it does not say otherwise:
///
///     struct BucketFill : scree::DefaultModel {
///       using Contact = scree::LinearSpring<scree::RollingResistance>;
///     };
///     scree::Simulation<BucketFill> simulation{{.local_damping = 0.1}};
struct DefaultModel {
  /// Of velocities, forces and histories: float or double. Positions are always double.
  using Real = double;
  /// See contact/concept.hpp.
  using Contact = LinearSpring<>;
  /// See neighbours/concept.hpp.
  using Neighbours = VerletList<CellGrid>;
  /// See integrators/concept.hpp.
  using Integrator = Leapfrog;
  /// The kinds of wall that may be added; see walls/concept.hpp.
  using Walls = scree::Walls<Fixed, Prescribed, ForceControlled, RopeCoupled>;
  /// Whether bodies that have come to rest are left alone: AllAwake or RestingRegions
  /// (simulation/resting.hpp).
  using Rest = AllAwake;
  /// Whether the work of friction, dashpots and local damping is summed.
  static constexpr bool energy_audit = true;
};

namespace detail {

template <class Model>
concept FillsAllSlots = requires {
  typename Model::Real;
  typename Model::Contact;
  typename Model::Neighbours;
  typename Model::Integrator;
  typename Model::Walls;
  { Model::Rest::rests } -> std::convertible_to<bool>;
  { Model::energy_audit } -> std::convertible_to<bool>;
};

/// Whether -1 or +1 is given for each history number.
template <HasHistory Contact>
constexpr bool parity_fits() {
  const auto& parity = Contact::history_parity;
  return parity.size() == static_cast<std::size_t>(Contact::history_size) &&
         std::all_of(parity.begin(), parity.end(), [](int p) { return p == -1 || p == 1; });
}

// The checks below state every requirement by itself, so that the compiler's message names the operation that
// is missing, and each only where those that it builds on hold, so that one mistake gives one message.

template <class Contact, class Real>
struct ContactCheck {
  static_assert(std::copyable<Contact>, "scree: Model::Contact cannot be copied (contact/concept.hpp)");
  static_assert(
      requires {
        { Contact::history_size } -> std::convertible_to<int>;
      },
      "scree: Model::Contact is missing history_size (contact/concept.hpp)");
  static_assert(
      requires { Contact::history_parity.size(); },
      "scree: Model::Contact is missing history_parity, an array (contact/concept.hpp)");
  static constexpr bool parity = [] {
    if constexpr (HasHistory<Contact>) {
      return parity_fits<Contact>();
    }
    return true;
  }();
  static_assert(
      parity, "scree: Model::Contact: history_parity must hold -1 or +1 for each of the history_size numbers "
              "(contact/concept.hpp)");
  static_assert(ChecksMaterials<Contact>,
                "scree: Model::Contact is missing check(pair, names) (contact/concept.hpp)");
  static_assert(
      StatesStiffness<Contact>,
      "scree: Model::Contact is missing stiffness(pair, reduced_radius, reduced_mass, speed) returning "
      "ContactStiffness (contact/concept.hpp)");
  static_assert(!HasHistory<Contact> || StatesEnergy<Contact>,
                "scree: Model::Contact is missing elastic_energy(pair, reduced_radius, overlap, history) "
                "(contact/concept.hpp)");
  static_assert(
      !HasHistory<Contact> || EvaluatesForce<Contact, Real>,
      "scree: Model::Contact is missing evaluate(pair, kinematics, history) for T = Model::Real, returning "
      "ContactForce<T> (contact/concept.hpp)");
  static constexpr bool done = true;
};

template <class Dynamics>
struct WallDynamicsCheck {
  static_assert(std::copyable<Dynamics>,
                "scree: a wall dynamics of Model::Walls cannot be copied (walls/concept.hpp)");
  static_assert(StartsWall<Dynamics>,
                "scree: a wall dynamics of Model::Walls is missing start(motion, step) (walls/concept.hpp)");
  static_assert(
      AdvancesWall<Dynamics>,
      "scree: a wall dynamics of Model::Walls is missing advance(motion, load, step) (walls/concept.hpp)");
  // With one alone the stable time step would leave out what holds the wall.
  static constexpr bool says_how_held = requires(const Dynamics& d) { d.squared_frequency(); };
  static constexpr bool says_by_what = requires(const Dynamics& d) { d.holder(); };
  static_assert(IsHeld<Dynamics> || !says_how_held,
                "scree: a wall dynamics of Model::Walls has squared_frequency() but is missing holder() "
                "(walls/concept.hpp)");
  static_assert(IsHeld<Dynamics> || !says_by_what,
                "scree: a wall dynamics of Model::Walls has holder() but is missing squared_frequency() "
                "(walls/concept.hpp)");
  static constexpr bool done = true;
};

template <class Walls>
inline constexpr bool lists_walls = false;
template <class... Dynamics>
inline constexpr bool lists_walls<Walls<Dynamics...>> = (WallDynamicsCheck<Dynamics>::done && ...);

template <class Model>
struct ModelCheck {
  static_assert(FillsAllSlots<Model>,
                "scree: Model is missing one of Real, Contact, Neighbours, Integrator, Walls, Rest, "
                "energy_audit: derive it from DefaultModel (simulation/model.hpp)");
  using Real = typename Model::Real;
  using Neighbours = typename Model::Neighbours;
  using Integrator = typename Model::Integrator;

  static_assert(std::is_same_v<Real, double> || std::is_same_v<Real, float>,
                "scree: Model::Real must be float or double");
  static_assert(ContactCheck<typename Model::Contact, Real>::done);
  static_assert(StatesSkin<Neighbours>,
                "scree: Model::Neighbours is missing skin(smallest_radius) (neighbours/concept.hpp)");
  static_assert(FindsCandidates<Neighbours>,
                "scree: Model::Neighbours is missing find(balls, owned, margin, workers, "
                "rows) (neighbours/concept.hpp)");
  static_assert(Translates<Integrator>, "scree: Model::Integrator is missing translate(position, velocity, "
                                        "acceleration, step) (integrators/concept.hpp)");
  static_assert(Rotates<Integrator>,
                "scree: Model::Integrator is missing rotate(orientation, angular_velocity, "
                "moment, inertia, step) (integrators/concept.hpp)");
  static_assert(lists_walls<typename Model::Walls>,
                "scree: Model::Walls must be scree::Walls<...>, a list of wall dynamics (walls/wall.hpp)");
  static constexpr bool holds = true;
};

} // namespace detail

/// Names what fills the slots of a model, as the compiler has it.
template <class Model>
std::string model_name() {
  const auto name = [](auto type) {
    return boost::typeindex::type_id<typename decltype(type)::type>().pretty_name();
  };
  return message("Real = ", name(std::type_identity<typename Model::Real>{}),
                 ", Contact = ", name(std::type_identity<typename Model::Contact>{}),
                 ", Neighbours = ", name(std::type_identity<typename Model::Neighbours>{}),
                 ", Integrator = ", name(std::type_identity<typename Model::Integrator>{}),
                 ", Walls = ", name(std::type_identity<typename Model::Walls>{}),
                 ", Rest = ", name(std::type_identity<typename Model::Rest>{}),
                 ", energy_audit = ", Model::energy_audit);
}

/// What a simulation is given at its start; every field has a default.
template <class Model = DefaultModel>
struct Setup {
  typename Model::Contact contact{};            ///< the law with the parameters of its extensions
  typename Model::Neighbours neighbours{};      ///< the search with its parameters
  typename Model::Rest rest{};                  ///< what counts as rest
  Stiffness stiffness = Stiffness::of_particle; ///< what the stiffness of a material stands for
  Vector gravity = Vector{0.0, 0.0, -9.81};     ///< m/s2
  Vector period = Vector::Zero();               ///< m, from 0 in each direction; 0: not periodic
  double time_step = 0.0;                       ///< s; 0: the stable one
  double step_safety = 0.8;         ///< share of the critical time step that counts as stable, in (0, 1]
  double top_speed = 1.0;           ///< m/s, of impacts, for the stiffness of Hertzian contacts, above 0
  double local_damping = 0.0;       ///< non-viscous, alpha in [0, 1): F_d = -alpha |F| sign(v)
  unsigned threads = 1;             ///< 0: one for each processor
  std::size_t sort_interval = 5000; ///< steps between sorting the bodies by place; 0: never
};

} // namespace scree
