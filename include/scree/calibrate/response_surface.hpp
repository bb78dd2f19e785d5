#pragma once
/// \file
/// How observables answer to parameters: kriging through noisy runs.

#include "scree/calibrate/kriging.hpp"
#include "scree/calibrate/reach.hpp"
#include "scree/core/error.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace scree {

/// One run: where in the parameters' shares, and what came out, as it is compared. What the run did not show
/// is not a number.
struct Run {
  Eigen::VectorXd at;
  Eigen::VectorXd observed;
};

/// For each observable, a surface over the parameters' shares. How far it bends and how much runs scatter is
/// averaged over many pairs of length and ratio, each counting as much as the runs speak for it, so few runs
/// give a plane and many runs any smooth shape.
class ResponseSurface {
public:
  /// \param runs for each observable, at least three more that show it than there are parameters
  /// \param null shares of those of the parameters, the last ones, whose effect is nothing there
  /// \param reach of the parameters; all of them may change observables beyond its end
  /// \throws Error for too few runs.
  explicit ResponseSurface(const std::vector<Run>& runs, const Eigen::VectorXd& null = {},
                           const Reach& reach = {}) {
    const Eigen::Index parameters = runs.empty() ? 0 : runs.front().at.size();
    const Eigen::Index m = runs.empty() ? 0 : runs.front().observed.size();
    const auto n = static_cast<Eigen::Index>(runs.size());
    require_enough(n, parameters);
    noise_ = Eigen::VectorXd::Zero(m);
    freedom_ = Eigen::VectorXd::Constant(m, static_cast<double>(n - parameters - 1));
    Eigen::MatrixXd left_out = Eigen::MatrixXd::Zero(n, m); // 0 where a run does not show the observable
    std::vector<Eigen::Index> all(static_cast<std::size_t>(parameters));
    std::iota(all.begin(), all.end(), Eigen::Index{0});
    std::map<Frame, std::vector<Eigen::Index>> observables_of;
    for (Eigen::Index k = 0; k < m; ++k) {
      const auto of = static_cast<std::size_t>(k);
      Frame frame{.touching = of < reach.size() ? reach[of] : all};
      for (Eigen::Index r = 0; r < n; ++r) {
        if (std::isfinite(runs[static_cast<std::size_t>(r)].observed[k])) {
          frame.shown.push_back(r);
        }
      }
      require_enough(static_cast<Eigen::Index>(frame.shown.size()), parameters);
      observables_of[std::move(frame)].push_back(k);
    }
    for (const auto& [frame, observables] : observables_of) {
      const auto count = static_cast<Eigen::Index>(frame.shown.size());
      // A column for each run: it is there even where no parameter touches the observables.
      Eigen::MatrixXd at(static_cast<Eigen::Index>(frame.touching.size()), count);
      Eigen::MatrixXd observed(static_cast<Eigen::Index>(observables.size()), count);
      for (Eigen::Index r = 0; r < count; ++r) {
        const Run& run = runs[static_cast<std::size_t>(frame.shown[static_cast<std::size_t>(r)])];
        at.col(r) = run.at(frame.touching);
        observed.col(r) = run.observed(observables);
      }
      // Those of the parameters that are effects, which are the last.
      std::vector<Eigen::Index> effects;
      for (const Eigen::Index k : frame.touching) {
        if (k >= parameters - null.size()) {
          effects.push_back(k - (parameters - null.size()));
        }
      }
      left_out(frame.shown, observables) =
          add_group(at.transpose(), observed.transpose(), observables, frame.touching, null(effects));
    }
    const Eigen::VectorXd size = left_out.colwise().norm().cwiseMax(1e-300);
    correlation_ = (size.cwiseInverse().asDiagonal() * (left_out.transpose() * left_out) *
                    size.cwiseInverse().asDiagonal());
    correlation_.diagonal().setOnes();
  }

  /// The surfaces of some observables, next to each other, as if there were no others.
  [[nodiscard]] ResponseSurface part(Eigen::Index first, Eigen::Index count) const {
    ResponseSurface out;
    out.noise_ = noise_.segment(first, count);
    out.freedom_ = freedom_.segment(first, count);
    out.correlation_ = correlation_.block(first, first, count, count);
    for (const Shared& shared : shared_) {
      std::vector<Surface> surfaces;
      for (const Surface& s : shared.surfaces) {
        if (s.observable >= first && s.observable < first + count) {
          surfaces.push_back({s.observable - first, s.weight, s.surface});
        }
      }
      if (!surfaces.empty()) {
        out.shared_.push_back({shared.frame, shared.touching, std::move(surfaces)});
      }
    }
    return out;
  }

  /// Degrees of freedom of the noise: of the observable that has fewest.
  [[nodiscard]] double freedom() const { return freedom_.minCoeff(); }
  /// Variance of each observable in single runs.
  [[nodiscard]] const Eigen::VectorXd& noise() const { return noise_; }
  /// Between the observables of single runs.
  [[nodiscard]] const Eigen::MatrixXd& correlation() const { return correlation_; }

  /// Means of the observables, and the variances of these means.
  struct Prediction {
    Eigen::VectorXd mean, variance;
  };
  [[nodiscard]] Prediction predicted(const Eigen::VectorXd& at) const {
    Prediction out{Eigen::VectorXd::Zero(noise_.size()), Eigen::VectorXd::Zero(noise_.size())};
    Eigen::VectorXd square = out.mean;
    for (const Shared& shared : shared_) {
      const KrigingFrame::Place place = shared.frame->place(at(shared.touching));
      const double variance = shared.frame->variance(place);
      for (const Surface& s : shared.surfaces) {
        const double mean = s.surface.mean(place);
        out.mean[s.observable] += s.weight * mean;
        square[s.observable] += s.weight * mean * mean;
        out.variance[s.observable] += s.weight * s.surface.noise() * variance;
      }
    }
    out.variance += (square - out.mean.cwiseAbs2()).cwiseMax(0.0);
    return out;
  }
  /// The means alone, which takes a small part of the work.
  [[nodiscard]] Eigen::VectorXd mean(const Eigen::VectorXd& at) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(noise_.size());
    for (const Shared& shared : shared_) {
      const KrigingFrame::Place place = shared.frame->place(at(shared.touching));
      for (const Surface& s : shared.surfaces) {
        out[s.observable] += s.weight * s.surface.mean(place);
      }
    }
    return out;
  }
  /// Observables by parameters: change per share, along some of the parameters.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::VectorXd& at, std::span<const Eigen::Index> along) const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(noise_.size(), static_cast<Eigen::Index>(along.size()));
    for (const Shared& shared : shared_) {
      const auto [there, columns] = shared.places_of(along);
      const Eigen::MatrixXd slopes = shared.frame->slopes(at(shared.touching), there);
      for (const Surface& s : shared.surfaces) {
        out(s.observable, columns) += s.weight * s.surface.slope(slopes, there).transpose();
      }
    }
    return out;
  }
  /// The same along the first `count` parameters.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::VectorXd& at, Eigen::Index count) const {
    std::vector<Eigen::Index> along(static_cast<std::size_t>(count));
    std::iota(along.begin(), along.end(), Eigen::Index{0});
    return slopes(at, along);
  }
  /// The same along all.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::VectorXd& at) const { return slopes(at, at.size()); }

private:
  /// One of the surfaces that an observable is averaged over.
  struct Surface {
    Eigen::Index observable;
    double weight; ///< they sum to 1 for each observable
    Kriging surface;
  };
  struct Shared {
    std::shared_ptr<const KrigingFrame> frame; ///< parts have it too
    std::vector<Eigen::Index> touching;        ///< parameters that are its coordinates
    std::vector<Surface> surfaces{};

    /// Which coordinates of the frame are among some of the parameters, and where among these.
    [[nodiscard]] std::pair<std::vector<Eigen::Index>, std::vector<Eigen::Index>>
    places_of(std::span<const Eigen::Index> parameters) const {
      std::pair<std::vector<Eigen::Index>, std::vector<Eigen::Index>> out;
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        const auto found = std::lower_bound(touching.begin(), touching.end(), parameters[p]);
        if (found != touching.end() && *found == parameters[p]) {
          out.first.push_back(found - touching.begin());
          out.second.push_back(static_cast<Eigen::Index>(p));
        }
      }
      return out;
    }
  };
  /// Runs and parameters; observables that both are the same for share their surfaces' frames.
  struct Frame {
    std::vector<Eigen::Index> shown{}, touching{};
    friend bool operator<(const Frame& a, const Frame& b) {
      return std::tie(a.shown, a.touching) < std::tie(b.shown, b.touching);
    }
  };

  ResponseSurface() = default;

  static void require_enough(Eigen::Index runs, Eigen::Index parameters) {
    if (runs < parameters + 3) {
      throw Error(message("response surface: ", runs, " runs came to an end, too few for ", parameters,
                          " parameters"));
    }
  }

  /// What processes may look like: a plane, and all in even steps.
  static std::vector<EffectsKernel::Shape> shapes(bool effects) {
    using Steps = std::vector<double>;
    // What is left to the first coordinates bends less where effects have terms of their own.
    const Steps lengths = effects ? Steps{0.4, 1.0, 2.5} : Steps{0.4, 0.8, 1.6};
    const Steps effect_lengths = effects ? Steps{0.3, 0.8} : Steps{1.0};
    const Steps strengths = effects ? Steps{0.5, 1.0, 2.0} : Steps{0.0};
    std::vector<EffectsKernel::Shape> out{{.length = 1.0, .ratio = 0.0}};
    for (const double length : lengths) {
      for (const double ratio : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 256.0}) {
        for (const double effect_length : effect_lengths) {
          for (const double strength : strengths) {
            out.push_back({length, ratio, effect_length, strength});
          }
        }
      }
    }
    return out;
  }

  /// Takes the surfaces that the runs speak for.
  /// \param observed a column for each of `observables`
  /// \param touching parameters that are the columns of `at`
  /// \param null of the last of these, that are effects
  /// \return what the likeliest surface of each leaves out
  Eigen::MatrixXd add_group(const Eigen::MatrixXd& at, const Eigen::MatrixXd& observed,
                            const std::vector<Eigen::Index>& observables,
                            const std::vector<Eigen::Index>& touching, const Eigen::VectorXd& null) {
    std::vector<Shared> group;
    for (const EffectsKernel::Shape& shape : shapes(null.size() > 0)) {
      group.push_back({std::make_shared<const KrigingFrame>(at, shape, null), touching});
    }
    Eigen::MatrixXd left_out(observed.rows(), observed.cols());
    for (Eigen::Index k = 0; k < observed.cols(); ++k) {
      const Eigen::Index observable = observables[static_cast<std::size_t>(k)];
      std::vector<Kriging> surfaces;
      surfaces.reserve(group.size());
      for (const Shared& shared : group) {
        surfaces.emplace_back(*shared.frame, observed.col(k));
      }
      const auto best = std::max_element(surfaces.begin(), surfaces.end(), [](const auto& a, const auto& b) {
        return a.log_likelihood() < b.log_likelihood();
      });
      const auto weight_of = [most = best->log_likelihood()](const Kriging& surface) {
        const double less = most - surface.log_likelihood();
        return less > 5.0 ? 0.0 : std::exp(-less);
      };
      double sum = 0.0;
      for (const Kriging& surface : surfaces) {
        sum += weight_of(surface);
      }
      double numbers = 0.0;
      for (std::size_t f = 0; f < group.size(); ++f) {
        const double weight = weight_of(surfaces[f]) / sum;
        if (weight > 0.0) {
          noise_[observable] += weight * surfaces[f].noise();
          numbers += weight * group[f].frame->numbers();
          group[f].surfaces.push_back({observable, weight, surfaces[f]});
        }
      }
      freedom_[observable] =
          std::min(freedom_[observable], std::max(1.0, static_cast<double>(observed.rows()) - numbers));
      left_out.col(k) = best->left_out(*group[static_cast<std::size_t>(best - surfaces.begin())].frame);
    }
    std::erase_if(group, [](const Shared& shared) { return shared.surfaces.empty(); });
    std::move(group.begin(), group.end(), std::back_inserter(shared_));
    return left_out;
  }

  std::vector<Shared> shared_;
  Eigen::VectorXd noise_, freedom_;
  Eigen::MatrixXd correlation_;
};

} // namespace scree
