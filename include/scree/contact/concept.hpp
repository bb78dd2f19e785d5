#pragma once
/// \file
/// What a contact law must offer.
///
/// A law is a small copyable value. It holds no state of any contact: that is in the history, `history_size`
/// numbers for each contact, all 0 when it begins.
///
///     static constexpr int history_size;
///     // For each history number: -1 if it changes sign when i and j change places (parts of a vector from
///     // j to i), else +1.
///     static constexpr std::array<int, history_size> history_parity;
///     // Refuses a pair of materials that lacks what the law needs; `names` says which pair it is.
///     void check(const PairMaterial<double>& pair, std::string_view names) const;
///     // The stiffest that a contact gets in an impact at `speed` [m/s] or below.
///     ContactStiffness stiffness(const PairMaterial<double>& pair, double reduced_radius,
///                                double reduced_mass, double speed) const;
///     // J, held in the springs of a contact.
///     double elastic_energy(const PairMaterial<double>& pair, double reduced_radius, double overlap,
///                           std::span<const double, history_size> history) const;
///     // Force and couple on i; reads and rewrites the history. No branch on the contact: T may be a pack.
///     template <class T>
///     ContactForce<T> evaluate(const PairMaterial<T>& pair, const Kinematics<T>& k,
///                              std::array<T, history_size>& history) const;
///
/// Given by the library: LinearSpring, HertzMindlin, each with any extensions (RollingResistance, ...).

#include "scree/contact/kinematics.hpp"

#include <array>
#include <concepts>
#include <span>
#include <string_view>

namespace scree {

template <class L>
concept HasHistory = requires {
  { L::history_size } -> std::convertible_to<int>;
  { L::history_parity.size() } -> std::convertible_to<std::size_t>;
};

template <class L>
concept ChecksMaterials = requires(const L& law, const PairMaterial<double>& pair, std::string_view names) {
  law.check(pair, names);
};

template <class L>
concept StatesStiffness = requires(const L& law, const PairMaterial<double>& pair, double number) {
  { law.stiffness(pair, number, number, number) } -> std::same_as<ContactStiffness>;
};

template <class L>
concept StatesEnergy = HasHistory<L> &&
    requires(const L& law, const PairMaterial<double>& pair, double number,
             std::span<const double, static_cast<std::size_t>(L::history_size)> history) {
  { law.elastic_energy(pair, number, number, history) } -> std::convertible_to<double>;
};

template <class L, class T>
concept EvaluatesForce = HasHistory<L> &&
    requires(const L& law, const PairMaterial<T>& pair, const Kinematics<T>& k,
             std::array<T, static_cast<std::size_t>(L::history_size)>& history) {
  { law.evaluate(pair, k, history) } -> std::same_as<ContactForce<T>>;
};

template <class L, class T = double>
concept ContactLaw = std::copyable<L> && HasHistory<L> && ChecksMaterials<L> && StatesStiffness<L> &&
    StatesEnergy<L> && EvaluatesForce<L, T>;

} // namespace scree
