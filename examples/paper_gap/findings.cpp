#include "findings.hpp"

#include "support/degree.hpp"

#include "scree/laboratory/bucket_path.hpp"

#include <algorithm>
#include <cmath>

namespace paper_gap {

namespace {

using scree::examples::degree;

double logarithm(double force) {
  return force > 0.0 ? std::log(force) : none;
}

Analysis analysis_of(std::span<const Done> runs, ReadingIndex what, bool logarithmic) {
  std::vector<Response> responses;
  for (const Done& run : runs) {
    if (run.in_design && run.outcome) {
      const double value = readings[what].of(*run.outcome);
      responses.push_back({run.run, logarithmic ? logarithm(value) : value});
    }
  }
  return analysed(responses);
}

MotionFinding finding_of(std::span<const Done> runs, Motion motion) {
  MotionFinding out{.motion = motion};
  std::array<std::vector<double>, readings.size()> values;
  for (const Done& run : runs) {
    if (run.run == 0 && run.of.motion == motion && run.outcome) {
      ++out.runs;
      for (std::size_t k = 0; k < readings.size(); ++k) {
        values[k].push_back(readings[k].of(*run.outcome));
      }
    }
  }
  for (std::size_t k = 0; k < readings.size(); ++k) {
    out.mean[k] = Mean{values[k]};
  }
  return out;
}

/// Whether there is a path with the pitch of a run: its bucket came to the end, and did not fall over.
bool has_path(const Outcome& run) {
  return std::all_of(run.pitch.begin(), run.pitch.end(),
                     [](double pitch) { return std::abs(pitch) * degree < scree::BucketPath::steepest; });
}

DepthCheck depth_check(const Base& base, std::span<const Done> runs) {
  std::vector<double> near, near_by_pitch, end, end_by_pitch;
  for (const Done& run : runs) {
    const bool free = run.of.motion == Motion::free && run.of.levels[5] < 0;
    if (!free || !run.outcome || !has_path(*run.outcome)) {
      continue;
    }
    near.push_back(Outcome::near(run.outcome->depth));
    near_by_pitch.push_back(depth_by_pitch(base, *run.outcome, 0.3));
    end.push_back(Outcome::end(run.outcome->depth));
    end_by_pitch.push_back(depth_by_pitch(base, *run.outcome, 0.95));
  }
  return {near.size(), Mean{near}, Mean{near_by_pitch}, Mean{end}, Mean{end_by_pitch}};
}

/// Whether a mean with the scatter of single replicates is within `tolerance` of what is stated, but for
/// twice its standard error.
bool agrees(double mean, double is_stated, double tolerance, double scatter, std::size_t runs) {
  const double noise = std::isfinite(scatter) ? 2.0 * scatter / std::sqrt(static_cast<double>(runs)) : 0.0;
  return std::abs(mean - is_stated) <= tolerance + noise;
}

std::vector<Agreement> agreements(std::span<const Done> runs, const Findings& f) {
  std::vector<Agreement> out;
  for (std::size_t r = 0; r < design().size(); ++r) {
    std::vector<double> near, end, pitch;
    for (const Done& run : runs) {
      if (run.in_design && run.run == r && run.outcome) {
        near.push_back(readings[force_near].of(*run.outcome));
        end.push_back(readings[force_end].of(*run.outcome));
        pitch.push_back(readings[pitch_near].of(*run.outcome));
      }
    }
    if (near.empty()) {
      continue;
    }
    Agreement a{r, Mean{near}, Mean{end}, Mean{pitch}, false, false};
    const auto force_fits = [&](const Mean& mean, double is_stated, const Analysis& of) {
      return agrees(logarithm(mean.value), std::log(is_stated), std::log(force_tolerance), of.scatter,
                    near.size());
    };
    const auto pitch_fits = [&](double is_stated) {
      return agrees(a.pitch_near.value, is_stated, pitch_tolerance, f.pitch_near.scatter, near.size());
    };
    const bool begins = force_fits(a.force_near, stated.force_near, f.log_force_near);
    a.with_measured =
        begins && force_fits(a.force_end, stated.force_end, f.log_force_end) && pitch_fits(stated.pitch_near);
    a.with_simulated = begins && force_fits(a.force_end, stated.simulated_end, f.log_force_end) &&
                       pitch_fits(stated.simulated_near);
    out.push_back(a);
  }
  return out;
}

} // namespace

Findings found(const Base& base, std::span<const Done> runs) {
  Findings out{.motions = {},
               .log_force_near = analysis_of(runs, force_near, true),
               .log_force_end = analysis_of(runs, force_end, true),
               .pitch_near = analysis_of(runs, pitch_near, false),
               .depth = depth_check(base, runs),
               .agreements = {}};
  for (const Motion motion : motions) {
    out.motions.push_back(finding_of(runs, motion));
  }
  out.agreements = agreements(runs, out);
  out.failed = static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [](const Done& run) { return !run.outcome; }));
  return out;
}

} // namespace paper_gap
