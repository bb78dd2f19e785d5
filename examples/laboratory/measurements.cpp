#include "laboratory/measurements.hpp"

#include "scree/core/error.hpp"
#include "scree/core/random.hpp"
#include "scree/io/csv.hpp"

#include <algorithm>
#include <cmath>

namespace scree::examples {

void write_measurements(const std::filesystem::path& folder, const Plan& plan, Trials& trials,
                        const std::vector<double>& parameters, const std::vector<Reading>& readings,
                        std::uint64_t seed) {
  Random noise{seed, "closed loop, noise"}, seeds{seed, "closed loop, seeds"};
  std::vector<Trials::Replicate> wanted;
  for (const Reading& reading : readings) {
    for (std::size_t k = 0; k < reading.replicates; ++k) {
      wanted.push_back({plan.experiments[plan.index_of(reading.experiment)], parameters,
                        seeds.index(std::size_t{1} << 53U)});
    }
  }
  const std::vector<RunOutcome> runs = trials.replicates(wanted);
  auto run = runs.begin();
  for (const Reading& reading : readings) {
    const auto observables = plan.experiments[plan.index_of(reading.experiment)].experiment->observables();
    std::vector<double> gains;
    for (const Observable& o : observables) {
      const auto gain = reading.gains.find(o.name);
      gains.push_back(gain == reading.gains.end() ? 1.0 : gain->second);
    }
    for (const auto& gain : reading.gains) {
      if (std::none_of(observables.begin(), observables.end(),
                       [&](const Observable& o) { return o.name == gain.first; })) {
        throw Error(message(reading.experiment, " has no observable '", gain.first, "'"));
      }
    }
    std::vector<std::vector<double>> rows;
    for (std::size_t k = 0; k < reading.replicates; ++k, ++run) {
      if (!run->failure.empty()) {
        throw Error(message(reading.experiment, ", replicate ", k + 1, ": ", run->failure));
      }
      rows.push_back(run->observed);
      for (std::size_t o = 0; o < rows.back().size(); ++o) {
        double& value = rows.back()[o];
        value = gains[o] * value + (reading.relative * value + reading.absolute) * noise.normal();
      }
    }
    // What some specimens do not show is not reported.
    std::vector<std::size_t> shown;
    std::vector<std::string> columns;
    for (std::size_t k = 0; k < observables.size(); ++k) {
      if (std::all_of(rows.begin(), rows.end(), [k](const auto& row) { return std::isfinite(row[k]); })) {
        shown.push_back(k);
        columns.push_back(observables[k].name);
      }
    }
    CsvWriter table{folder / message(reading.experiment, ".csv"), columns, "One replicate a row."};
    for (const auto& row : rows) {
      std::vector<double> values;
      for (const std::size_t k : shown) {
        values.push_back(row[k]);
      }
      table.row(values);
    }
  }
}

} // namespace scree::examples
