#pragma once
/// \file
/// The causes that a diagnosis considers.

#include "laboratory/plan.hpp"

#include "scree/diagnose/cause.hpp"

#include <string>
#include <vector>

namespace diagnose {

/// All causes that experiments on rock can show, with null values of the plan's rock. Those whose parameter
/// the plan looks for anyway are left out.
/// \param only names, with commas between them; empty: all
/// \throws Error for a name that is none of them.
std::vector<scree::Cause> catalogue(const scree::examples::Plan& plan, const std::string& only);

} // namespace diagnose
