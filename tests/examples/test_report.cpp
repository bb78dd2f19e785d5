#include "diagnose/report.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

using namespace scree;

TEST_CASE("the model to write has every parameter of every cause that is named, and none where nothing is") {
  const ModelSpace space{{{.name = "friction", .least = 0.1, .most = 0.9}},
                         {{"load_cell",
                           {{"load_cell_gain", "", 0.7, 1.4}, {"load_cell_offset", "N", -50.0, 50.0}},
                           {1.0, 0.0},
                           "Gear::reading"},
                          {"adhesion", {{"adhesion", "J/m2", 0.0, 4.0}}, {0.0}, "LinearSpring<Adhesion>"}}};
  Diagnosis diagnosis;
  diagnosis.ranking.push_back(
      {.causes = {0, 1}, .parameters = {{1, 1.2, 1.1, 1.3}, {2, -8.0, -9.0, -7.0}, {3, 1.5, 1.0, 2.0}}});
  diagnosis.finding = Finding::causes;
  diagnosis.named = {0};
  diagnose::Diagnosed diagnosed{space, {}, {}, RunLog{space.parameters(), {}}, nullptr, std::move(diagnosis)};
  CHECK(diagnose::model_to_write({diagnosed, 0.0}) ==
        std::vector<std::string>{
            "Gear::reading: load_cell_gain = 1.2 (1.1 to 1.3), load_cell_offset = -8 N (-9 to -7)",
            "LinearSpring<Adhesion>: adhesion = 1.5 J/m2 (1 to 2)"});
  CHECK(diagnose::sentence({diagnosed, 0.0}).find("load_cell_offset = -8 N") != std::string::npos);
  diagnosed.diagnosis.finding = Finding::unexplained;
  CHECK(diagnose::model_to_write({diagnosed, 0.0}).empty());
}
