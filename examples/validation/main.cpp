/// \brief Everything checked against theory, experiment and other codes: one table and one page of curves.
/// \smoke --case normal_impact

#include "cases.hpp"
#include "page.hpp"
#include "table.hpp"

#include "scree/io/atomic_file.hpp"
#include "support/options.hpp"
#include "support/progress.hpp"
#include "support/results.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

namespace ex = scree::examples;

int run(int argc, char** argv) {
  std::string out, reference, only;
  bool full = false;
  std::uint64_t threads = 0;
  std::vector<validation::Case> cases = validation::all_cases();
  std::vector<std::string> names{""};
  for (const auto& c : cases) {
    names.push_back(c.name);
  }
  ex::Options options{"validation", "Checks scree against theory, experiment and other codes."};
  options.add("out", out, {}, "folder for the results; none: results/validation-K");
  options.add("reference", reference, {}, "folder of measured and published data; none: theory only");
  options.add("case", only, names, "only this case");
  options.add("full", full, "full size, where a case has a smaller one");
  options.add("threads", threads, {0.0, 1024.0},
              "0: one for each processor; the results are the same for any");
  options.parse(argc, argv);
  std::erase_if(cases, [&](const auto& c) { return !only.empty() && c.name != only; });

  const auto folder = ex::results_folder(out, "validation");
  const validation::Inputs inputs{reference, full, static_cast<unsigned>(threads)};
  const std::string made_by = fmt::format("scree {}.", ex::versions().value("scree", ""));
  validation::Table table{folder / "validation.csv"};
  std::vector<validation::Outcome> outcomes;
  std::size_t all = 0, failed = 0;
  ex::Progress progress;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    progress(static_cast<double>(k) / static_cast<double>(cases.size()), cases[k].brief);
    outcomes.push_back(cases[k].run(inputs));
    for (const validation::Finding& f : outcomes.back().findings) {
      table.add(f);
      ++all;
      if (!f.pass()) {
        ++failed;
        progress.close();
        fmt::print("{}, {}: {:.6g} {}, reference {:.6g}\n", f.case_name, f.quantity, f.simulated, f.unit,
                   f.reference);
      }
    }
    scree::write_atomically(folder / "validation.html", validation::page(outcomes, made_by));
  }
  progress.close();
  fmt::print("{} quantities, {} outside their tolerance\nresults: {}\n", all, failed, folder.string());
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const ex::HelpWanted& help) {
    fmt::print("{}", help.text);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "validation: {}\n", error.what());
    return 2;
  }
}
