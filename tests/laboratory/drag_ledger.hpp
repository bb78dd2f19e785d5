#pragma once
/// \file
/// Where the energy of a drag goes.

#include "scree/walls/rope_coupled.hpp"
#include "support/scenes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace scree::test {

/// What grains, bucket and ropes have, and what went in and out since it was opened, in J. Holds while no
/// grain is added or taken away.
template <class Rig>
class DragLedger {
public:
  /// \param rig with the bucket in place; must outlive this
  explicit DragLedger(const Rig& rig)
      : rig_{rig}, start_{held()}, dissipated_before_{dissipated()}, wound_before_{winch_work()} {
    for (std::size_t k = 0; k < 2; ++k) {
      stretch_[k] = taut(k);
    }
  }

  /// After every step: what the dashpots of the ropes took in it.
  void observe() {
    for (std::size_t k = 0; k < 2; ++k) {
      const Rope& rope = rig_.ropes()[k];
      const double stretch = taut(k);
      in_ropes_ += (rope.tension - rope.stiffness * stretch) * (stretch - stretch_[k]);
      stretch_[k] = stretch;
    }
  }

  [[nodiscard]] double put_in() const { return winch_work() - wound_before_; }
  [[nodiscard]] double lost() const { return dissipated() - dissipated_before_ + in_ropes_; }
  /// What is not accounted for.
  [[nodiscard]] double missing() const { return start_ + put_in() - lost() - held(); }

private:
  [[nodiscard]] double held() const {
    const auto& simulation = rig_.simulation();
    const RopeCoupled& bucket = dynamics();
    double sum =
        mechanical_energy(simulation) + bucket.kinetic_energy() -
        bucket.mass() * simulation.setup().gravity.dot(rig_.bucket_motion().to_space(bucket.centre()));
    for (std::size_t k = 0; k < 2; ++k) {
      sum += 0.5 * rig_.ropes()[k].stiffness * taut(k) * taut(k);
    }
    return sum;
  }
  [[nodiscard]] double dissipated() const { return rig_.simulation().dissipation().total(); }
  [[nodiscard]] double winch_work() const { return rig_.ropes()[0].winch_work + rig_.ropes()[1].winch_work; }
  [[nodiscard]] double taut(std::size_t rope) const { return std::max(0.0, rig_.ropes()[rope].stretch); }
  [[nodiscard]] const RopeCoupled& dynamics() const {
    constexpr std::size_t bucket = 1; // the trough was the first wall
    return rig_.simulation().template dynamics<RopeCoupled>(bucket);
  }

  const Rig& rig_;
  double in_ropes_ = 0.0;
  std::array<double, 2> stretch_{};
  double start_, dissipated_before_, wound_before_;
};

} // namespace scree::test
