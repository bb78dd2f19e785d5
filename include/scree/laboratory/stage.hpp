#pragma once
/// \file
/// How an experiment says how far it is.

#include "scree/core/error.hpp"

#include <string>

namespace scree {

/// What an experiment is at, for those who watch it.
struct Stage {
  std::string name;
  double share = 0.0; ///< rough share of the experiment that is done, 0 to 1
};

/// Refuses a second run of an experiment, whose grains are not where the first one began.
class RunsOnce {
public:
  /// \throws Error where it was called before.
  void begin(const char* experiment) {
    if (begun_) {
      throw Error(message(experiment, ": this experiment has run; make another one"));
    }
    begun_ = true;
  }

private:
  bool begun_ = false;
};

} // namespace scree
