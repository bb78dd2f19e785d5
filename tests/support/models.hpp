#pragma once
/// \file
/// Simulations that several tests use, each compiled once, in models/.

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/linear_spring.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/simulation/simulation.hpp"

#include <type_traits>

namespace scree::test {

template <class Law, class Number>
struct OtherModel : DefaultModel {
  using Real = Number;
  using Contact = Law;
};

/// The default model with another law or number type; the default itself where neither is another.
template <class Law, class Number = double>
using ModelOf = std::conditional_t<std::is_same_v<Law, DefaultModel::Contact> &&
                                       std::is_same_v<Number, DefaultModel::Real>,
                                   DefaultModel, OtherModel<Law, Number>>;

using RollingLinear = ModelOf<LinearSpring<RollingResistance>>;
using Hertzian = ModelOf<HertzMindlin<>>;
using RollingHertzian = ModelOf<HertzMindlin<RollingResistance>>;
using LinearInFloat = ModelOf<LinearSpring<>, float>;
using HertzianInFloat = ModelOf<HertzMindlin<>, float>;

} // namespace scree::test

extern template class scree::Simulation<>;
extern template class scree::Simulation<scree::test::RollingLinear>;
extern template class scree::Simulation<scree::test::Hertzian>;
extern template class scree::Simulation<scree::test::RollingHertzian>;
extern template class scree::Simulation<scree::test::LinearInFloat>;
extern template class scree::Simulation<scree::test::HertzianInFloat>;
