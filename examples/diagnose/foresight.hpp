#pragma once
/// \file
/// What rivals say of experiments that were not done yet.

#include "laboratory/plan.hpp"
#include "laboratory/trials.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace diagnose {

/// One observable of such an experiment.
struct Foreseen {
  std::string observable;   ///< with its unit
  std::vector<double> mean; ///< of each rival
  double scatter = 0.0;     ///< of one measurement around it, standard deviation, of all rivals together
  double apart = 0.0;       ///< of the two rivals that it tells apart worst: see `foresee`
};

struct ForeseenExperiment {
  std::string name, kind;
  std::vector<Foreseen> observables{}; ///< the one that tells most first
  double apart = 0.0;                  ///< of the two rivals that no observable of it tells apart better
  std::string failure{};               ///< why it says nothing; empty where it does
};

/// Simulates every experiment of the plan that was not done yet with every rival. Two rivals are apart by the
/// difference of their means over the standard deviation of one measurement and of what few replicates leave
/// open of the means, with one scatter for all rivals.
/// \param rivals parameters of the whole space, two or more
/// \param replicates of each, two or more
/// \return the experiment that tells all rivals from each other best first
std::vector<ForeseenExperiment> foresee(const scree::examples::Plan& plan, scree::examples::Trials& trials,
                                        const std::vector<std::vector<double>>& rivals,
                                        std::size_t replicates);

} // namespace diagnose
