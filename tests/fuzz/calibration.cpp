#include "fuzz/attempt.hpp"
#include "fuzz/readers.hpp"

#include "laboratory/measured_folder.hpp"

namespace scree::test {

void read_as_calibration(std::string_view bytes) {
  file_with("a.csv", "bulk_density_kg_m3\n1500\n1510\n");
  const auto file = file_with("calibration.toml", bytes);
  // What is wrong with a table is said of the table.
  attempt(file.parent_path().string(), [&] {
    const examples::Plan plan = examples::read_plan(file.parent_path());
    insist(!plan.space.empty() && plan.space.size() == plan.start.size(), "a plan looks for nothing");
    for (std::size_t k = 0; k < plan.space.size(); ++k) {
      insist(plan.space[k].least < plan.space[k].most, "bounds of a parameter are none");
      insist(plan.space[k].least <= plan.start[k] && plan.start[k] <= plan.space[k].most,
             "a search starts out of bounds");
    }
    for (const auto& e : plan.experiments) {
      insist(!e.measured.empty() && e.measured.size() == e.used.size(), "an experiment has no data");
    }
  });
}

} // namespace scree::test
