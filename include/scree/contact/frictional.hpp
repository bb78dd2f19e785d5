#pragma once
/// \file
/// The part that all laws share: a spring and dashpot in normal and tangential direction, Coulomb's limit,
/// and the places where extensions join in.
///
/// An extension is a small type with
///
///     static constexpr int history_size;                       // may be 0
///     static constexpr std::array<int, history_size> history_parity;
///
/// and one or more of
///
///     // Changes the normal force [N] before the friction limit is taken from it. What that dissipates in
///     // this step is added to lost_work [J].
///     template <class T> T normal(const PairMaterial<T>&, const Kinematics<T>&, T normal_force,
///                                 std::span<T, history_size> history, T& lost_work) const;
///     // Changes the coefficient of friction of a contact that slips at slip_speed [m/s].
///     template <class T> T friction(const PairMaterial<T>&, const Kinematics<T>&, T coefficient,
///                                   T slip_speed, std::span<T, history_size> history) const;
///     // Is told what sliding dissipated in this step [J].
///     template <class T> void slid(const PairMaterial<T>&, T work, std::span<T, history_size> history)
///     const;
///     // Adds to the couple on i [N m].
///     template <class T> Vec3<T> couple(const PairMaterial<T>&, const Kinematics<T>&, T normal_stiffness,
///                                       T normal_force, std::span<T, history_size> history,
///                                       T& frictional_work) const;
///
/// beside which it may have
///
///     // Throws Error for parameters that do not fit, with the names of the two materials.
///     void check(const PairMaterial<double>&, std::string_view names) const;
///     // The stiffest that a contact gets, where without the extension it is `base`.
///     ContactStiffness stiffness(ContactStiffness base, const PairMaterial<double>&, double reduced_radius,
///                                double reduced_mass, double speed) const;
///     // J, held beside what the law without the extension holds.
///     double elastic_energy(const PairMaterial<double>&, double reduced_radius, double overlap,
///                           std::span<const double, history_size> history) const;
///
/// With its parameter at the null value it must leave the base law's result as it is, to the bit.

#include "scree/contact/concept.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace scree {

namespace detail {

template <class E, class T>
using HistoryOf = std::span<T, static_cast<std::size_t>(E::history_size)>;

} // namespace detail

/// Whether an extension changes the normal force.
template <class E, class T = double>
concept ChangesNormalForce = requires(const E& extension, const PairMaterial<T>& pair, const Kinematics<T>& k,
                                      T force, detail::HistoryOf<E, T> history, T& work) {
  { extension.normal(pair, k, force, history, work) } -> std::same_as<T>;
};

/// Whether an extension changes the coefficient of friction.
template <class E, class T = double>
concept ChangesFriction = requires(const E& extension, const PairMaterial<T>& pair, const Kinematics<T>& k,
                                   T coefficient, T speed, detail::HistoryOf<E, T> history) {
  { extension.friction(pair, k, coefficient, speed, history) } -> std::same_as<T>;
};

/// Whether an extension is to be told of sliding.
template <class E, class T = double>
concept FeelsSliding = requires(const E& extension, const PairMaterial<T>& pair, T work,
                                detail::HistoryOf<E, T> history) {
  extension.slid(pair, work, history);
};

/// Whether an extension adds to the couple.
template <class E, class T = double>
concept AddsCouple = requires(const E& extension, const PairMaterial<T>& pair, const Kinematics<T>& k,
                              T stiffness, T force, detail::HistoryOf<E, T> history, T& work) {
  { extension.couple(pair, k, stiffness, force, history, work) } -> std::same_as<Vec3<T>>;
};

namespace detail {

/// States what an extension lacks. One whose operations do not fit would otherwise be left out without a
/// word.
template <class E>
struct ExtensionCheck {
  static_assert(std::copyable<E>,
                "scree: an extension of a contact law cannot be copied (contact/frictional.hpp)");
  static_assert(HasHistory<E>,
                "scree: an extension of a contact law is missing history_size or history_parity "
                "(contact/frictional.hpp)");
  static constexpr bool has_normal = requires { &E::template normal<double>; };
  static constexpr bool has_friction = requires { &E::template friction<double>; };
  static constexpr bool has_slid = requires { &E::template slid<double>; };
  static constexpr bool has_couple = requires { &E::template couple<double>; };
  static_assert(!HasHistory<E> || has_normal || has_friction || has_couple,
                "scree: an extension of a contact law has none of normal, friction and couple, each a "
                "template of a number type (contact/frictional.hpp)");
  static_assert(!HasHistory<E> || !has_normal || ChangesNormalForce<E>,
                "scree: an extension's normal does not fit normal(pair, k, normal_force, history, lost_work) "
                "returning T (contact/frictional.hpp)");
  static_assert(!HasHistory<E> || !has_friction || ChangesFriction<E>,
                "scree: an extension's friction does not fit friction(pair, k, coefficient, slip_speed, "
                "history) returning T (contact/frictional.hpp)");
  static_assert(!HasHistory<E> || !has_slid || FeelsSliding<E>,
                "scree: an extension's slid does not fit slid(pair, work, history) "
                "(contact/frictional.hpp)");
  static_assert(!HasHistory<E> || !has_couple || AddsCouple<E>,
                "scree: an extension's couple does not fit couple(pair, k, normal_stiffness, normal_force, "
                "history, frictional_work) returning Vec3<T> (contact/frictional.hpp)");
  static constexpr bool done = true;
};

} // namespace detail

template <class E>
concept LawExtension = std::copyable<E> && HasHistory<E> &&
    (ChangesNormalForce<E> || ChangesFriction<E> || AddsCouple<E>);

/// What a normal model (Linear, Hertz) says of one contact. Stiffness of 0 in shear means no tangential
/// spring.
template <class T>
struct SpringDashpot {
  T normal_force;            ///< N, elastic
  T normal_stiffness;        ///< N/m, tangent
  T shear_stiffness;         ///< N/m, tangent
  T inverse_shear_stiffness; ///< m/N
  T normal_damping;          ///< N s/m
  T shear_damping;           ///< N s/m
  T spring_loss{};           ///< J, that the tangential spring lost as its stiffness changed
};

/// Turns a tangential vector with its contact, to third order in the angle of one step, and puts it into the
/// plane normal to the contact. No root and no quotient: this is done for every contact in every step.
template <class T>
[[gnu::always_inline]] inline Vec3<T> turned_with_contact(const Vec3<T>& spring, const Kinematics<T>& k) {
  const Vec3<T> once = cross(k.turn, spring);
  const Vec3<T> turned = (spring + once) + cross(k.turn * T(0.5), once);
  return negated_multiply_add(k.normal, dot(turned, k.normal), turned);
}

/// A contact law made of a normal model and any number of extensions.
///
/// Normal force: spring and dashpot, never below 0 but by an extension.
///
/// Tangential force: F_s = s' - c_s v_t with the spring force s turned with the contact and
/// s' = s - k_s v_t dt, neither of them beyond mu F_n (Coetzee et al. 2010 Eq. (2), in three dimensions).
///
/// History: three numbers of the tangential spring force [N], those of the normal model, those of each
/// extension.
template <class NormalModel, class... Extensions>
class FrictionalLaw {
  static_assert((detail::ExtensionCheck<Extensions>::done && ...));
  static constexpr int own = 3 + NormalModel::history_size;

public:
  static constexpr int history_size = (own + ... + Extensions::history_size);
  static constexpr std::array<int, history_size> history_parity = [] {
    std::array<int, history_size> parity{};
    int at = 0;
    const auto append = [&](const auto& part) {
      for (const int p : part) {
        parity[static_cast<std::size_t>(at++)] = p;
      }
    };
    append(std::array{-1, -1, -1});
    append(NormalModel::history_parity);
    (append(Extensions::history_parity), ...);
    return parity;
  }();

  FrictionalLaw() = default;
  explicit FrictionalLaw(const Extensions&... extensions) requires(sizeof...(Extensions) > 0)
      : extensions_{extensions...} {}

  /// The parameters of one extension.
  template <class E>
  [[nodiscard]] const E& extension() const {
    return std::get<E>(extensions_);
  }
  template <class E>
  [[nodiscard]] E& extension() {
    return std::get<E>(extensions_);
  }

  void check(const PairMaterial<double>& pair, std::string_view names) const {
    NormalModel::check(pair, names);
    const auto check_one = [&](const auto& extension) {
      if constexpr (requires { extension.check(pair, names); }) {
        extension.check(pair, names);
      }
    };
    std::apply([&](const auto&... extension) { (check_one(extension), ...); }, extensions_);
  }

  [[nodiscard]] ContactStiffness stiffness(const PairMaterial<double>& pair, double reduced_radius,
                                           double reduced_mass, double speed) const {
    ContactStiffness stiffest = NormalModel::stiffness(pair, reduced_radius, reduced_mass, speed);
    const auto extend = [&](const auto& extension) {
      if constexpr (requires { extension.stiffness(stiffest, pair, reduced_radius, reduced_mass, speed); }) {
        stiffest = extension.stiffness(stiffest, pair, reduced_radius, reduced_mass, speed);
      }
    };
    std::apply([&](const auto&... extension) { (extend(extension), ...); }, extensions_);
    return stiffest;
  }

  [[nodiscard]] double
  elastic_energy(const PairMaterial<double>& pair, double reduced_radius, double overlap,
                 std::span<const double, static_cast<std::size_t>(history_size)> h) const {
    const double spring = h[0] * h[0] + h[1] * h[1] + h[2] * h[2];
    double energy = NormalModel::elastic_energy(pair, reduced_radius, overlap) +
                    0.5 * spring * NormalModel::inverse_shear_stiffness(pair, reduced_radius, overlap);
    for_each_extension(h, [&](const auto& extension, auto own_history) {
      if constexpr (requires { extension.elastic_energy(pair, reduced_radius, overlap, own_history); }) {
        energy += extension.elastic_energy(pair, reduced_radius, overlap, own_history);
      }
    });
    return energy;
  }

  template <class T>
  [[gnu::always_inline]] ContactForce<T>
  evaluate(const PairMaterial<T>& pair, const Kinematics<T>& k,
           std::array<T, static_cast<std::size_t>(history_size)>& history) const {
    Vec3<T> spring = turned_with_contact(Vec3<T>{history[0], history[1], history[2]}, k);
    const SpringDashpot<T> at =
        NormalModel::evaluate(pair, k, spring, part<3, NormalModel::history_size>(history));

    const T normal_speed = dot(k.velocity, k.normal);
    const Vec3<T> slip_velocity = negated_multiply_add(k.normal, normal_speed, k.velocity);
    ContactForce<T> out;
    // Rock does not pull: where the dashpot would outweigh the spring, the contact is over.
    const T pushing = larger(negated_multiply_add(at.normal_damping, normal_speed, at.normal_force), T(0));
    out.normal = pushing;
    for_each_extension(std::span{history}, [&](const auto& extension, auto own_history) {
      if constexpr (ChangesNormalForce<std::decay_t<decltype(extension)>, T>) {
        out.normal = extension.normal(pair, k, out.normal, own_history, out.frictional_work);
      }
    });
    T coefficient = pair.friction;
    if constexpr ((ChangesFriction<Extensions, T> || ...)) {
      const T slip_speed = square_root(squared_norm(slip_velocity));
      for_each_extension(std::span{history}, [&](const auto& extension, auto own_history) {
        if constexpr (ChangesFriction<std::decay_t<decltype(extension)>, T>) {
          coefficient = extension.friction(pair, k, coefficient, slip_speed, own_history);
        }
      });
    }

    const T limit = coefficient * larger(out.normal, T(0));
    const Vec3<T> trial = negated_multiply_add(slip_velocity, at.shear_stiffness * k.dt, spring);
    const Vec3<T> wanted = negated_multiply_add(slip_velocity, at.shear_damping, trial);
    const T wanted2 = squared_norm(wanted);
    const auto sliding = wanted2 > limit * limit;
    Vec3<T> tangential = wanted, kept = trial;
    if (any(sliding)) {
      tangential =
          wanted * select(sliding, limit * reciprocal_square_root(select(sliding, wanted2, T(1))), T(1));
    }
    const T trial2 = squared_norm(trial);
    const auto yielding = trial2 > limit * limit;
    if (any(yielding)) {
      kept = trial * select(yielding, limit * reciprocal_square_root(select(yielding, trial2, T(1))), T(1));
    }
    out.tangential = tangential;
    history[0] = kept.x;
    history[1] = kept.y;
    history[2] = kept.z;
    // Of the tangential displacement, -(kept - spring)/k_s loads the spring and the rest slides.
    const T sliding_work = dot(tangential, trial - kept) * at.inverse_shear_stiffness;
    out.frictional_work += sliding_work + at.spring_loss;
    out.viscous_work = multiply_add((at.normal_force - pushing) * normal_speed, k.dt,
                                    dot(tangential - kept, kept - spring) * at.inverse_shear_stiffness);
    for_each_extension(std::span{history}, [&](const auto& extension, auto own_history) {
      if constexpr (FeelsSliding<std::decay_t<decltype(extension)>, T>) {
        extension.slid(pair, sliding_work, own_history);
      }
      if constexpr (AddsCouple<std::decay_t<decltype(extension)>, T>) {
        out.couple +=
            extension.couple(pair, k, at.normal_stiffness, out.normal, own_history, out.frictional_work);
      }
    });
    return out;
  }

private:
  template <int first, int count, class T>
  static std::span<T, static_cast<std::size_t>(count)>
  part(std::array<T, static_cast<std::size_t>(history_size)>& history) {
    return std::span<T, static_cast<std::size_t>(count)>{history.data() + first,
                                                         static_cast<std::size_t>(count)};
  }

  /// Number of the first history value of the extension at `index`.
  static constexpr int begin_of(std::size_t index) {
    constexpr std::array<int, sizeof...(Extensions) + 1> sizes{Extensions::history_size..., 0};
    int at = own;
    for (std::size_t k = 0; k < index; ++k) {
      at += sizes[k];
    }
    return at;
  }

  /// \param history of the contact, whole
  template <class T, class Visit>
  void for_each_extension(std::span<T, static_cast<std::size_t>(history_size)> history, Visit visit) const {
    [&]<std::size_t... index>(std::index_sequence<index...>) {
      (visit(std::get<index>(extensions_),
             std::span<T, static_cast<std::size_t>(Extensions::history_size)>{
                 history.data() + begin_of(index), static_cast<std::size_t>(Extensions::history_size)}),
       ...);
    }
    (std::index_sequence_for<Extensions...>{});
  }

  [[no_unique_address]] std::tuple<Extensions...> extensions_;
};

} // namespace scree
