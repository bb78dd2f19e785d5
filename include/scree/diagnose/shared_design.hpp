#pragma once
/// \file
/// Runs from which all causes are judged at once.

#include "scree/core/random.hpp"
#include "scree/diagnose/cause.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace scree {

namespace detail {

/// One of `count` even steps each, in random order, somewhere within the step: from 0 to 1.
inline std::vector<double> even_steps(std::size_t count, Random& random) {
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count);
  }
  random.shuffle(std::span{out});
  return out;
}

} // namespace detail

/// Points of the space, in shares: the base parameters as a Latin hypercube over all of them, and in each
/// run `active` causes at values of their own, all others null; every fourth run has none, as the base model
/// is part of every question and lies at the edge of the space. Each cause is active equally often, as far as
/// numbers allow, and takes even steps over its range then. Data have few causes too, so these runs lie where
/// answers are wanted, and few of them tell much: a cause is judged from all runs, not from its own.
inline std::vector<Eigen::VectorXd> shared_design(const ModelSpace& space, std::size_t runs,
                                                  std::size_t active, Random& random) {
  std::vector<Eigen::VectorXd> points(runs, space.null());
  for (Eigen::Index k = 0; k < space.base(); ++k) {
    const auto steps = detail::even_steps(runs, random);
    for (std::size_t r = 0; r < runs; ++r) {
      points[r][k] = steps[r];
    }
  }
  const std::size_t causes = space.causes().size();
  if (causes == 0) {
    return points;
  }
  // Rounds through all causes, each in another order, dealt out run by run.
  std::vector<std::vector<std::size_t>> runs_of(causes);
  std::vector<std::size_t> pile;
  for (std::size_t r = 0; r < runs; ++r) {
    if (r % 4 == 3) {
      continue;
    }
    std::vector<std::size_t> dealt;
    while (dealt.size() < std::min(active, causes)) {
      if (pile.empty()) {
        for (std::size_t c = 0; c < causes; ++c) {
          pile.push_back(c);
        }
        random.shuffle(std::span{pile});
      }
      // The topmost that this run does not have yet.
      auto top = pile.end();
      while (top != pile.begin() && std::find(dealt.begin(), dealt.end(), *(top - 1)) != dealt.end()) {
        --top;
      }
      if (top == pile.begin()) {
        pile.clear();
        continue;
      }
      dealt.push_back(*(top - 1));
      runs_of[*(top - 1)].push_back(r);
      pile.erase(top - 1);
    }
  }
  for (std::size_t c = 0; c < causes; ++c) {
    for (const Eigen::Index k : space.parameters_of({c})) {
      const auto steps = detail::even_steps(runs_of[c].size(), random);
      for (std::size_t n = 0; n < steps.size(); ++n) {
        points[runs_of[c][n]][k] = steps[n];
      }
    }
  }
  return points;
}

} // namespace scree
