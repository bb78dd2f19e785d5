#pragma once
/// \file
/// A rock with all that may be changed in a simulation of it, or of a rig that digs in it.

#include "scree/contact/adhesion.hpp"
#include "scree/contact/attrition.hpp"
#include "scree/contact/linear_spring.hpp"
#include "scree/contact/normal_exponent.hpp"
#include "scree/contact/normal_hysteresis.hpp"
#include "scree/contact/rate_friction.hpp"
#include "scree/contact/rolling_resistance.hpp"
#include "scree/laboratory/gear.hpp"
#include "scree/laboratory/rock_sample.hpp"
#include "scree/simulation/model.hpp"

namespace scree {

/// The linear law with every extension that there is.
using ExtendedLaw =
    LinearSpring<NormalExponent, NormalHysteresis, Adhesion, RateFriction, Attrition, RollingResistance>;

struct ExtendedModel : DefaultModel {
  using Contact = ExtendedLaw;
};

struct RockModel {
  RockSample sample;
  /// Null but for the dashpot of rolling (ours), which acts where rocks resist rolling at all.
  ExtendedLaw law{NormalExponent{}, NormalHysteresis{}, Adhesion{},
                  RateFriction{},   Attrition{},        RollingResistance{.damping = 0.3}};
  double packing_friction = 1.0; ///< FillRecipe::packing_friction of what is filled with it
  double local_damping = 0.0;    ///< Setup::local_damping of the experiments on it, but for the drag
  Gear gear{};                   ///< of the drag in it

  /// Whether the base law does not do, as an extension has another value than null.
  [[nodiscard]] bool extended() const {
    return law.extension<NormalExponent>().exponent != 1.0 ||
           law.extension<NormalHysteresis>().ratio != 1.0 || law.extension<Adhesion>().work != 0.0 ||
           law.extension<RateFriction>().slope != 0.0 || law.extension<Attrition>().rate != 0.0 ||
           sample.rock.rolling_friction != 0.0 || sample.rig.rolling_friction != 0.0;
  }
};

/// Calls `run` with the physics of the model: those of the base law where that does, else of the extended
/// one. Both give the same bits where all extensions are null.
/// \param common settings that both take over
template <class Run>
decltype(auto) with_physics(const RockModel& model, const Setup<>& common, const Run& run) {
  if (!model.extended()) {
    return run(common);
  }
  return run(Setup<ExtendedModel>{.contact = model.law,
                                  .neighbours = common.neighbours,
                                  .stiffness = common.stiffness,
                                  .gravity = common.gravity,
                                  .period = common.period,
                                  .time_step = common.time_step,
                                  .step_safety = common.step_safety,
                                  .top_speed = common.top_speed,
                                  .local_damping = common.local_damping,
                                  .threads = common.threads,
                                  .sort_interval = common.sort_interval});
}

} // namespace scree
