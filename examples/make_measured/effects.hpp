#pragma once
/// \file
/// What may be hidden in made data.

#include "laboratory/plan.hpp"

#include "scree/calibrate/parameter.hpp"
#include "scree/core/random.hpp"

#include <string>
#include <vector>

namespace make_measured {

/// A parameter of the rock or the rig that the laboratory has and the base model has not. Of effects with two
/// parameters there are two.
struct Effect {
  std::string name; ///< as in verdicts
  std::string form; ///< empty: that of the causes of the diagnosis
  scree::Parameter parameter;
  double value = 0.0;
};

/// Reads "NAME=VALUE,NAME=auto". Where an effect has two parameters, "NAME=VALUE:VALUE" gives both, each a
/// number or auto, "NAME=VALUE" the first alone, and "NAME=auto" draws both. "NAME:FORM=..." is the same
/// cause in another form than the diagnosis has of it.
/// \param plan whose rock has the null values, and whose experiments are to show it
/// \param sizes where sizes are drawn from
/// \throws Error for a name that is none, an effect that no experiment shows, or a value out of range.
std::vector<Effect> effects_in(const std::string& text, const scree::examples::Plan& plan,
                               scree::Random& sizes);

} // namespace make_measured
