/// \brief Makes data as a laboratory would, with effects in them that a base model does not have.
/// \smoke --plan @PROJECT_SOURCE_DIR@/tests/examples/measured/immersion --replicates 2

#include "make_measured/laboratory.hpp"

#include "support/crew.hpp"
#include "support/options.hpp"

#include "scree/laboratory/campaign.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

namespace {

using namespace scree;
namespace ex = scree::examples;

struct Wish {
  make_measured::Order order;
  std::string out, kept;
  std::uint64_t workers = 0;
};

void bind(ex::Options& options, Wish& w) {
  options.add_repeatable(
      "effect", w.order.effects,
      "NAME=VALUE in the unit of its parameter, NAME=VALUE:VALUE where it has two, or NAME=auto for a size "
      "drawn from the seed; NAME:FORM is the same cause in another form; none: nothing is hidden");
  options.add_repeatable("misread", w.order.misread,
                         "EXPERIMENT.OBSERVABLE=FACTOR by which it is read off too high");
  options.add_repeatable("misstated", w.order.misstated,
                         "KEY=VALUE as it was, where calibration.toml says otherwise");
  options.add("out", w.out, {},
              "folder for measured/ and, apart from it, truth.json; none: results/make_measured-K");
  options.add("kept", w.kept, {}, "folder that keeps every run; none: runs/ in the folder for the results");
  options.add("plan", w.order.plan, {},
              "the experiments: desk, of rock; mini, of some tens of softer grains; micro, of most of them "
              "round; drag, of these and a bucket dragged through them; or a folder with calibration.toml");
  options.add("replicates", w.order.replicates, {2.0, 1e4}, "of each experiment");
  options.add("reading_error", w.order.reading_error, {0.0, 1.0}, "relative, of a folder's experiments");
  options.add("seed", w.order.seed, {0.0, 9e15}, "of the rock, of specimens, readings and sizes of effects");
  options.add("limit", w.order.limit, {1e-3, 1e6, "s"}, "of simulated time of one run");
  options.add("step_safety", w.order.step_safety, {0.01, 1.0},
              "share of the critical time step; less than that of those who diagnose");
  options.add("workers", w.workers, {0.0, 1024.0}, "runs side by side; 0: one for each processor");
}

void work(const Wish& wish, const ex::Options& options, ex::CrewOfProgram& crew) {
  const ex::CrewFolders folders = crew.folders(wish.out, "make_measured", false);
  options.write_toml(folders.own / "input.toml");
  const Campaign campaign{wish.kept.empty() ? folders.common / "runs" : std::filesystem::path{wish.kept},
                          static_cast<unsigned>(wish.workers), crew.crew()};
  make_measured::measure(wish.order, folders.own, campaign, crew.first());
  fmt::print("measured: {}\ntruth, to be opened after the verdict: {}\n", (folders.own / "measured").string(),
             (folders.own / "truth.json").string());
}

} // namespace

int main(int argc, char** argv) {
  return ex::run_with_crew("make_measured", argc, argv, [&](ex::CrewOfProgram& crew) {
    Wish wish;
    ex::Options options{"make_measured", "Makes data as a laboratory would, with effects hidden in them."};
    bind(options, wish);
    options.parse(argc, argv);
    work(wish, options, crew);
  });
}
