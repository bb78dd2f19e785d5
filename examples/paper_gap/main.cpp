/// \brief What carries the factor of three between the paper's simulated and its measured drag force (Coetzee et al. 2010, section 7).
/// \smoke --experiments replay --replicates 2 --rock.size_factor 3 --bed.length 0.8 --bed.width 0.4 --bed.depth 0.2 --bed.unbalanced 0.3 --rig.bucket_start 0.1 --rig.drag_distance 0.06

#include "findings.hpp"
#include "report.hpp"
#include "runs.hpp"

#include "scree/io/atomic_file.hpp"
#include "scree/io/number_text.hpp"
#include "scree/io/read_text.hpp"
#include "scree/laboratory/campaign.hpp"
#include "support/crew.hpp"
#include "support/options.hpp"
#include "support/progress.hpp"
#include "support/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace scree;
namespace ex = scree::examples;
using Json = nlohmann::ordered_json;

struct Wish {
  std::string out, experiments = "all", fidelity = "desk";
  bool resume = false;
  std::uint64_t replicates = 3, seed = 1, workers = 0;
  double minutes = 0.0;
};

class Work {
public:
  Work(Wish wish, const ex::Options& options, paper_gap::Base base, ex::CrewOfProgram& crew)
      : wish_{std::move(wish)},
        base_{std::move(base)},
        crew_{crew},
        folders_{crew.folders(wish_.out, "paper_gap", wish_.resume)},
        campaign_{folders_.common / "runs", static_cast<unsigned>(wish_.workers), crew.crew()} {
    if (crew.first()) {
      progress_.emplace();
    }
    options.write_toml(folders_.own / "input.toml");
    paper_gap::Base shared = base_;
    ex::Options key{"paper_gap", ""};
    shared.bind(key);
    key_ = message("scree ", SCREE_VERSION, " paper_gap ", key.json().dump());
    head_["program"] = "paper_gap";
    head_["finished"] = false;
    head_["versions"] = ex::versions();
    head_["input"] = options.json();
    head_["defaults_not_in_the_paper"] = options.not_in_the_paper();
    ex::write_json(folders_.own / "summary.json", head_);
  }

  /// One replicate of all after another, and a report after each, so that there is always one to read.
  void operator()() {
    const std::vector<Planned> plan = planned();
    expected_ = plan.size() * wish_.replicates + (wanted("design") ? 2 : 0);
    dense_density_ = wanted("design") ? dense_density() : 1.0;
    for (std::uint64_t k = 0; k < wish_.replicates; ++k) {
      const std::size_t all = plan.size() * wish_.replicates, before = runs_.size();
      do_replicate(plan, wish_.seed + k);
      head_["finished"] = runs_.size() == all;
      if (k > 0 && runs_.size() == before) {
        break; // no time was left for any of it
      }
      report(all);
    }
    if (progress_) {
      progress_->close();
    }
    fmt::print("results: {}\n", folders_.own.string());
  }

private:
  /// A run but for its seed.
  struct Planned {
    paper_gap::Levels levels;
    paper_gap::Motion motion;
    std::size_t run;
    bool in_design;
  };

  [[nodiscard]] bool wanted(const char* what) const {
    return wish_.experiments == "all" || wish_.experiments == what;
  }

  /// The replayed paths first; the free bucket among them is the first run of the design.
  [[nodiscard]] std::vector<Planned> planned() const {
    const std::vector<paper_gap::Levels> design = paper_gap::design();
    std::vector<Planned> out;
    for (const paper_gap::Motion motion : paper_gap::motions) {
      if (wanted("replay") || motion == paper_gap::Motion::free) {
        out.push_back({design.front(), motion, 0, motion == paper_gap::Motion::free});
      }
    }
    for (std::size_t r = 1; r < design.size() && wanted("design"); ++r) {
      out.push_back({design[r], paper_gap::Motion::free, r, true});
    }
    return out;
  }

  /// Whether the time given is over, for all processes at once.
  [[nodiscard]] bool time_is_over() const {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begin_;
    const bool over = wish_.minutes > 0.0 && since.count() > 60.0 * wish_.minutes;
    const Crew& crew = crew_.crew();
    return crew.size > 1 ? crew.exchange(over ? "over" : "").front() == "over" : over;
  }

  /// The outcomes of the jobs, or none of those that were not kept when the time was over.
  std::vector<std::optional<JobOutcome>> run(const std::vector<Job>& jobs) {
    std::vector<std::optional<JobOutcome>> out(jobs.size());
    const std::size_t workers = wish_.workers > 0 ? wish_.workers : std::thread::hardware_concurrency();
    const std::size_t at_once = std::max<std::size_t>(1, workers) * crew_.crew().size;
    for (std::size_t next = 0; next < jobs.size();) {
      const bool over = time_is_over();
      std::vector<Job> batch;
      std::vector<std::size_t> places;
      while (next < jobs.size() && (wish_.minutes == 0.0 || batch.size() < at_once)) {
        if (!over || std::filesystem::exists(campaign_.file_of(jobs[next].key))) {
          batch.push_back(jobs[next]);
          places.push_back(next);
        }
        ++next;
      }
      std::vector<JobOutcome> outcomes =
          campaign_.run(batch, [this](std::size_t, std::size_t, const JobOutcome& last) { tell_of(last); });
      for (std::size_t k = 0; k < places.size(); ++k) {
        out[places[k]] = std::move(outcomes[k]);
      }
    }
    return out;
  }

  void tell_of(const JobOutcome& last) {
    ++done_;
    kept_ += last.kept ? 1 : 0;
    failed_ += last.failure.empty() ? 0 : 1;
    if (progress_) {
      // Those kept from before took no time, and tell nothing of what is left.
      const double share = done_ == expected_
                               ? 1.0
                               : static_cast<double>(done_ - kept_) / static_cast<double>(expected_ - kept_);
      (*progress_)(share,
                   fmt::format("{} runs of {}, {} of them kept from before, {} failed", done_, expected_,
                               kept_, failed_),
                   !last.kept);
    }
  }

  /// Of particles, for a dense bed of the bulk density of a loose one: both weighed once, by the first seed.
  double dense_density() {
    std::vector<Job> jobs;
    for (const bool dense : {false, true}) {
      jobs.push_back({message(key_, dense ? " dense" : " loose", " bed alone, seed=", wish_.seed),
                      [this, dense] { return std::vector<double>{bulk_density(base_, dense, wish_.seed)}; }});
    }
    const std::vector<std::optional<JobOutcome>> beds = run(jobs);
    for (const std::optional<JobOutcome>& bed : beds) {
      if (!bed || !bed->failure.empty()) {
        throw Error(message("bed alone: ", bed ? bed->failure : "no time for it"));
      }
    }
    return beds[0]->values.at(0) / beds[1]->values.at(0);
  }

  [[nodiscard]] Job job(const Planned& p, std::uint64_t seed, const std::vector<double>& free_depth) const {
    const paper_gap::Case one{p.levels, p.motion, seed, free_depth};
    std::string key =
        message(key_, " dense=", number_text(dense_density_), " motion=", static_cast<int>(p.motion));
    for (const int level : p.levels) {
      key += level > 0 ? " +" : " -";
    }
    return {message(key, " seed=", seed),
            [this, one] { return paper_gap::dragged(base_, one, dense_density_).values(); }};
  }

  /// The first run, free with all factors low, goes ahead: its depth is asked for by another.
  void do_replicate(const std::vector<Planned>& plan, std::uint64_t seed) {
    std::vector<double> free_depth;
    std::vector<std::optional<JobOutcome>> outcomes = run({job(plan.front(), seed, free_depth)});
    if (outcomes.front() && outcomes.front()->failure.empty()) {
      free_depth = paper_gap::Outcome::from(outcomes.front()->values).depth;
    }
    std::vector<Job> jobs;
    for (std::size_t k = 1; k < plan.size(); ++k) {
      jobs.push_back(job(plan[k], seed, free_depth));
    }
    for (std::optional<JobOutcome>& outcome : run(jobs)) {
      outcomes.push_back(std::move(outcome));
    }
    for (std::size_t k = 0; k < plan.size(); ++k) {
      if (!outcomes[k]) {
        continue;
      }
      runs_.push_back({.of = {plan[k].levels, plan[k].motion, seed},
                       .run = plan[k].run,
                       .in_design = plan[k].in_design,
                       .outcome = {},
                       .failure = outcomes[k]->failure});
      if (outcomes[k]->failure.empty()) {
        runs_.back().outcome = paper_gap::Outcome::from(outcomes[k]->values);
      }
    }
  }

  void report(std::size_t all) {
    const paper_gap::Findings findings = paper_gap::found(base_, runs_);
    const paper_gap::Report r{base_, findings, runs_, wish_.fidelity, dense_density_, all};
    const std::filesystem::path& folder = folders_.own;
    const std::string complaint = paper_gap::write_tables(r, folder);
    fmt::print(stderr, "{}", complaint);
    const std::string figure = complaint.empty() && std::filesystem::exists(folder / "paper_gap.svg")
                                   ? read_text(folder / "paper_gap.svg", std::size_t{1} << 26U)
                                   : std::string{};
    write_atomically(folder / "paper_gap.html",
                     paper_gap::page(r, figure.substr(std::min(figure.size(), figure.find("<svg")))));
    Json summary = head_;
    summary.update(paper_gap::summary(r));
    ex::write_json(folder / "summary.json", summary);
    if (progress_) {
      progress_->close();
    }
    for (const std::string& sentence : paper_gap::sentences(r)) {
      fmt::print("{}\n", sentence);
    }
  }

  Wish wish_;
  paper_gap::Base base_;
  const ex::CrewOfProgram& crew_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  ex::CrewFolders folders_;
  Campaign campaign_;
  std::optional<ex::Progress> progress_;
  std::string key_;
  Json head_;
  double dense_density_ = 1.0;
  std::vector<paper_gap::Done> runs_;
  std::size_t expected_ = 0, done_ = 0, kept_ = 0, failed_ = 0;
};

void run(int argc, char** argv, ex::CrewOfProgram& crew) {
  Wish wish;
  wish.fidelity = ex::Options::peek(argc, argv, "fidelity").value_or("desk");
  paper_gap::Base base{wish.fidelity == "desk"};
  ex::Options options{"paper_gap",
                      "What carries the factor of three between simulated and measured drag force."};
  options.add("fidelity", wish.fidelity, {"desk", "lab"}, "which set of defaults");
  options.add("out", wish.out, {}, "folder for the results; none: results/paper_gap-K");
  options.add("resume", wish.resume,
              "go on in a folder that was begun: runs that are kept there are not repeated");
  options.add("experiments", wish.experiments, {"all", "replay", "design"},
              "the replayed paths, the design of six factors, or both");
  options.add("replicates", wish.replicates, {1.0, 1e4}, "of each run, with other seeds");
  options.add("seed", wish.seed, {0.0, 9e15}, "of the first replicate; the others follow");
  options.add("workers", wish.workers, {0.0, 1024.0}, "runs side by side; 0: one for each processor");
  options.add("minutes", wish.minutes, {0.0, 1e6, "min"},
              "after which no run begins and the report is made of what there is; 0: as long as it takes");
  base.bind(options);
  options.parse(argc, argv);
  (void)paper_gap::path_of(base, {.levels = {}, .motion = paper_gap::Motion::measured}); // before any run
  Work{wish, options, base, crew}();
}

} // namespace

int main(int argc, char** argv) {
  return ex::run_with_crew("paper_gap", argc, argv, [&](ex::CrewOfProgram& crew) { run(argc, argv, crew); });
}
