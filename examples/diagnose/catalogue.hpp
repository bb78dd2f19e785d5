#pragma once
/// \file
/// The causes that a diagnosis considers.

#include "laboratory/plan.hpp"

#include "scree/diagnose/cause.hpp"

#include <string>
#include <vector>

namespace diagnose {

/// All causes that the experiments of a plan can show, with null values of its rock and rig. Parameters that
/// the plan looks for anyway are left out, and causes that have no other.
/// \param only names, with commas between them; empty: all
/// \throws Error for a name that is none of them.
std::vector<scree::Cause> catalogue(const scree::examples::Plan& plan, const std::string& only);

} // namespace diagnose
