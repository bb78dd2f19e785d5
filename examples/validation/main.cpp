/// \brief Everything checked against theory, experiment and other codes: one table and one page of curves.
#include "normal_impact.hpp"
#include "oblique_impact.hpp"
#include <fmt/format.h>
#include <iostream>
int main(int argc, char** argv) {
  using namespace validation;
  Inputs in;
  if (argc > 1)
    in.reference = argv[1];
  try {
    for (const Outcome& o :
         {elastic_normal_impact(in), restitution(in), kharaz<scree::HertzMindlin<>>(in, "Hertz-Mindlin"),
          kharaz<scree::LinearSpring<>>(in, "linear")}) {
      for (auto& f : o.findings)
        fmt::print("{:32} {:55} {:12.6g} {:12.6g} err {:10.3g} tol {:8.2g} {}\n", f.case_name, f.quantity,
                   f.reference, f.simulated, f.error(), f.tolerance.size, f.pass() ? "pass" : "FAIL");
      for (auto& n : o.notes)
        fmt::print("note {}\n", n);
    }
  } catch (std::exception& e) {
    fmt::print("error {}\n", e.what());
  }
}
