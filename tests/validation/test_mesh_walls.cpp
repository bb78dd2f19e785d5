#include "validation/case_check.hpp"

using scree::test::check_case;

TEST_CASE("grains dropped on a mesh and on the plane it stands for") {
  check_case("mesh_drop");
}

TEST_CASE("a sphere that rolls over a mesh and over the plane it stands for") {
  check_case("mesh_roll");
}

TEST_CASE("a sphere that rolls in a tessellated tube") {
  check_case("mesh_tube");
}

TEST_CASE("physics: a silo as a cylinder and as meshes") {
  check_case("mesh_silo");
}

TEST_CASE("physics: a hopper as planes and as meshes") {
  check_case("mesh_hopper");
}
