#pragma once
/// \file
/// The contact law of a case: as part of a model, and by its name.

#include "scree/contact/hertz_mindlin.hpp"
#include "scree/contact/linear_spring.hpp"
#include "scree/simulation/model.hpp"

#include <type_traits>

namespace validation {

template <class Law>
struct WithLaw : scree::DefaultModel {
  using Contact = Law;
};
/// The default model with another law.
template <class Law>
using With =
    std::conditional_t<std::is_same_v<Law, scree::DefaultModel::Contact>, scree::DefaultModel, WithLaw<Law>>;

template <class Law>
inline constexpr const char* law_name = "";
template <class... Extensions>
inline constexpr const char* law_name<scree::LinearSpring<Extensions...>> = "linear";
template <class... Extensions>
inline constexpr const char* law_name<scree::HertzMindlin<Extensions...>> = "Hertz-Mindlin";

template <class Law>
inline constexpr bool is_hertz = false;
template <class... Extensions>
inline constexpr bool is_hertz<scree::HertzMindlin<Extensions...>> = true;

} // namespace validation
