#pragma once
/// \file
/// How an experiment says how far it is.

#include <string>

namespace scree {

/// What an experiment is at, for those who watch it.
struct Stage {
  std::string name;
  double share = 0.0; ///< rough share of the experiment that is done, 0 to 1
};

} // namespace scree
