#include "validation/case_check.hpp"
#include "validation/dosta.hpp"

#include "scree/core/error.hpp"

using scree::test::check_case;
using scree::test::reference_file;

TEST_CASE("the benchmark's beds: packed files are unpacked, the malformed row of the ball is left out") {
  const auto impact = reference_file("dosta2024/initial/Penetration_25KParticles.txt.gz");
  const auto drum = reference_file("dosta2024/initial/Drum_PartCoordinates.txt.gz");
  const auto walls = reference_file("dosta2024/initial/Drum_walls.txt.gz");
  if (!impact || !drum || !walls) {
    return;
  }
  const auto bed = validation::dosta::read_spheres(*impact);
  CHECK(bed.size() == 25000);
  CHECK(std::all_of(bed.begin(), bed.end(), [](const scree::Sphere& s) { return s.radius == 0.001; }));
  const auto beads = validation::dosta::read_spheres(*drum);
  CHECK(beads.size() == 38000);
  CHECK(std::count_if(beads.begin(), beads.end(), [](const scree::Sphere& s) { return s.radius == 0.002; }) ==
        8000);
  CHECK(validation::dosta::read_mesh(*walls).facets.size() == 1200);
}

TEST_CASE("the benchmark's files: one that is not there is named") {
  CHECK_THROWS_WITH_AS((void)validation::read_packed_text("nowhere/bed.txt.gz"),
                       "nowhere/bed.txt.gz: cannot be opened for reading", scree::Error);
}

TEST_CASE("long: a silo runs out: Dosta et al. 1") {
  if (reference_file("dosta2024/timings.json")) {
    check_case("dosta_silo");
  }
}

TEST_CASE("long: beads mix in a drum: Dosta et al. 2") {
  if (reference_file("dosta2024/timings.json")) {
    check_case("dosta_drum");
  }
}

TEST_CASE("physics: a ball strikes a bed: Dosta et al. 3") {
  if (reference_file("dosta2024/timings.json")) {
    check_case("dosta_impact");
  }
}
