#pragma once
/// \file
/// A parameter that is to be found.

#include "scree/core/error.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace scree {

/// A number of a model, between bounds. Inside, it runs from 0 to 1: evenly, or evenly in its logarithm.
struct Parameter {
  std::string name;
  std::string unit{};
  double least = 0.0, most = 1.0;
  bool logarithmic = false; ///< for what spans decades; least must be above 0
  /// Kinds of experiment whose results it can change; empty: all.
  std::vector<std::string> touches{};

  /// \throws Error for bounds that are none.
  void check() const {
    if (!(least < most) || !std::isfinite(least) || !std::isfinite(most) || (logarithmic && !(least > 0.0))) {
      throw Error(message("parameter ", name, ": bounds ", least, " to ", most, " ", unit,
                          logarithmic ? " must ascend from above 0" : " must ascend"));
    }
  }

  /// From 0 to 1 to the parameter's unit, and beyond the bounds likewise.
  [[nodiscard]] double value(double share) const {
    return logarithmic ? least * std::pow(most / least, share) : least + share * (most - least);
  }
  [[nodiscard]] double share(double value) const {
    return logarithmic ? std::log(value / least) / std::log(most / least) : (value - least) / (most - least);
  }
};

} // namespace scree
