#pragma once
/// \file
/// How measured and simulated numbers scatter, and how to draw them again.

#include "scree/calibrate/discrepancy.hpp"
#include "scree/calibrate/measured.hpp"
#include "scree/calibrate/response_surface.hpp"
#include "scree/core/random.hpp"
#include "scree/diagnose/scatter_prior.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace scree {

/// What a laboratory reports of all observables: means, as compared, and how surely they are known.
struct Readings {
  Eigen::VectorXd mean;
  Eigen::VectorXd variance; ///< of the mean, as estimated from the replicates
};

/// The noise of measurements and simulations; what was measured on the same specimens scatters together, and
/// as much as simulated specimens do where these are alike (`ScatterPrior`).
class Noise {
public:
  struct Group {
    std::vector<Eigen::Index> members; ///< observables
    double freedom;                    ///< degrees, behind the variances that were measured
    Eigen::MatrixXd correlation;
    Eigen::MatrixXd root; ///< lower triangle L with L L^T = correlation
  };

  Noise(std::span<const Measured> measured, const ResponseSurface& response)
      : simulated_freedom_{response.freedom()}, prior_{ScatterPrior::seen_from(measured, response.noise())} {
    const auto m = static_cast<Eigen::Index>(measured.size());
    readings_.mean.resize(m);
    readings_.variance.resize(m);
    std::map<std::string, std::size_t> known;
    for (Eigen::Index k = 0; k < m; ++k) {
      const Measured& one = measured[static_cast<std::size_t>(k)];
      readings_.mean[k] = one.mean();
      readings_.variance[k] = variance_of(one);
      double freedom = one.freedom();
      if (prior_.holds[static_cast<std::size_t>(k)]) {
        const double beforehand =
            prior_.ratio * response.noise()[k] / static_cast<double>(one.replicates.size());
        readings_.variance[k] =
            (freedom * readings_.variance[k] + prior_.freedom * beforehand) / (freedom + prior_.freedom);
        freedom += prior_.freedom;
      }
      const auto [at, added] = known.emplace(one.specimens, groups_.size());
      if (added) {
        groups_.push_back({{}, most_freedom, {}, {}});
      }
      Group& group = groups_[at->second];
      group.members.push_back(k);
      group.freedom = std::min(group.freedom, freedom);
    }
    const Eigen::MatrixXd together = correlation_of_noise(measured, response);
    for (Group& group : groups_) {
      group.correlation = together(group.members, group.members);
      group.root = group.correlation.llt().matrixL();
    }
  }

  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }
  [[nodiscard]] double simulated_freedom() const { return simulated_freedom_; }
  [[nodiscard]] const Readings& readings() const { return readings_; }
  [[nodiscard]] const ScatterPrior& prior() const { return prior_; }

  /// As the laboratory would read other specimens, were `mean` the truth and their scatter as it was
  /// measured.
  [[nodiscard]] Readings drawn(const Eigen::VectorXd& mean, Random& random) const {
    Readings out{mean + normal(readings_.variance, random), readings_.variance};
    for (const Group& group : groups_) {
      for (const Eigen::Index k : group.members) {
        out.variance[k] *=
            group.freedom < most_freedom ? random.chi_squared(group.freedom) / group.freedom : 1.0;
      }
    }
    return out;
  }

  /// A normal draw with these variances, correlated within groups.
  [[nodiscard]] Eigen::VectorXd normal(const Eigen::VectorXd& variance, Random& random) const {
    Eigen::VectorXd out(variance.size());
    for (const Group& group : groups_) {
      Eigen::VectorXd even(group.root.rows());
      for (double& x : even) {
        x = random.normal();
      }
      const Eigen::VectorXd together = group.root * even;
      for (std::size_t n = 0; n < group.members.size(); ++n) {
        const Eigen::Index k = group.members[n];
        out[k] = std::sqrt(variance[k]) * together[static_cast<Eigen::Index>(n)];
      }
    }
    return out;
  }

private:
  static constexpr double most_freedom = 1e6; // as good as none missing

  std::vector<Group> groups_;
  Readings readings_;
  double simulated_freedom_;
  ScatterPrior prior_;
};

} // namespace scree
