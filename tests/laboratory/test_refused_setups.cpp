/// \file
/// Every number of every setup refuses what is out of its range, and says which it is.

#include "scree/laboratory/bed_recipe.hpp"
#include "scree/laboratory/drop_test.hpp"
#include "scree/laboratory/gear.hpp"
#include "scree/laboratory/heap_setup.hpp"
#include "scree/laboratory/oedometer_setup.hpp"
#include "scree/laboratory/round_container.hpp"
#include "scree/laboratory/tilt_test_setup.hpp"
#include "scree/measure/watchdog.hpp"
#include "scree/simulation/resting.hpp"
#include "support/refusals.hpp"

#include <doctest/doctest.h>

using namespace scree;
using test::infinite;
using test::not_a_number;

TEST_CASE("recipes of beds and fillings refuse what is out of range") {
  SCREE_REFUSES(RestCriterion, unbalanced, "rest: unbalanced", 0.0, -1.0, not_a_number, infinite);
  SCREE_REFUSES(RestCriterion, speed, "rest: speed", 0.0, -1.0, not_a_number, infinite);
  SCREE_REFUSES(RestCriterion, moving, "rest: moving", -0.1, 1.1, not_a_number);
  SCREE_REFUSES(RestCriterion, patience, "rest: patience", 0.0, -1.0, not_a_number, infinite);
  SCREE_REFUSES(BedRecipe, porosity, "bed porosity", 0.01, 0.96, -0.4, not_a_number);
  SCREE_REFUSES(BedRecipe, porosity_tolerance, "bed porosity_tolerance", 0.0, not_a_number);
  SCREE_REFUSES(BedRecipe, surplus, "bed surplus", 0.0, -0.1, not_a_number);
  SCREE_REFUSES(BedRecipe, expected_porosity, "bed expected_porosity", 0.0, 1.0, not_a_number);
  SCREE_REFUSES(BedRecipe, settling_damping, "bed settling_damping", -0.1, 1.0, not_a_number);
  SCREE_REFUSES(BedRecipe, packing_friction, "bed packing_friction", 0.0, 1e4, not_a_number);
  SCREE_REFUSES(BedRecipe, rest.speed, "rest: speed", 0.0, not_a_number);
  SCREE_REFUSES(FillRecipe, surplus, "fill surplus", 0.0, -1.0, not_a_number);
  SCREE_REFUSES(FillRecipe, expected_porosity, "fill expected porosity", 0.0, 1.0, not_a_number);
  SCREE_REFUSES(FillRecipe, settling_damping, "fill settling damping", -0.1, 1.0, not_a_number);
  SCREE_REFUSES(FillRecipe, packing_friction, "fill packing friction", 0.0, 1e4, not_a_number);
  SCREE_REFUSES(RoundContainer, radius, "container radius", 0.0, -1.0, not_a_number, infinite);
  SCREE_REFUSES(RoundContainer, height, "container height", 0.0, -1.0, not_a_number, infinite);
}

TEST_CASE("oedometers and heaps refuse what is out of range") {
  SCREE_REFUSES(OedometerSetup, low_stress, "oedometer low_stress", 0.0, -1.0, not_a_number);
  SCREE_REFUSES(OedometerSetup, high_stress, "oedometer high_stress", 0.0, 1e3, not_a_number);
  SCREE_REFUSES(OedometerSetup, cycles, "oedometer cycles", 0U, 1001U);
  SCREE_REFUSES(OedometerSetup, strain_rate, "oedometer strain_rate", 0.0, not_a_number);
  SCREE_REFUSES(OedometerSetup, most_inertial_number, "oedometer most_inertial_number", 0.0, not_a_number);
  SCREE_REFUSES(OedometerSetup, approach, "oedometer approach", 0.5, not_a_number);
  SCREE_REFUSES(OedometerSetup, approach_to, "oedometer approach_to", 0.0, 1.1, not_a_number);
  SCREE_REFUSES(OedometerSetup, slope_from, "oedometer slope_from", -0.1, not_a_number);
  SCREE_REFUSES(OedometerSetup, slope_to, "oedometer slope_to", 0.2, 1.1, not_a_number);
  SCREE_REFUSES(OedometerSetup, points, "oedometer points", 9U);
  SCREE_REFUSES(OedometerSetup, container.radius, "container radius", 0.0, not_a_number);
  SCREE_REFUSES(OedometerSetup, fill.surplus, "fill surplus", 0.0, not_a_number);
  SCREE_REFUSES(HeapSetup, plate_friction, "heap plate_friction", -1.0, not_a_number);
  SCREE_REFUSES(HeapSetup, lift_speed, "heap lift_speed", 0.0, not_a_number);
  SCREE_REFUSES(HeapSetup, patience, "heap patience", 0.0, not_a_number);
  SCREE_REFUSES(HeapSetup, tube.radius, "tube radius", 0.0, not_a_number);
  SCREE_REFUSES(HeapSetup, tube.height, "tube height", 0.0, not_a_number);
  SCREE_REFUSES(HeapSetup, funnel.outlet, "funnel outlet", 0.0, 0.3, not_a_number);
  SCREE_REFUSES(HeapSetup, funnel.rim, "funnel rim", 0.1, not_a_number);
  SCREE_REFUSES(HeapSetup, funnel.steepness, "funnel steepness", 0.0, 1.6, not_a_number);
  SCREE_REFUSES(HeapSetup, funnel.clearance, "funnel clearance", 0.0, not_a_number);
  SCREE_REFUSES(HeapSetup, funnel.lift_speed, "funnel lift_speed", -0.1, not_a_number);
  SCREE_REFUSES(HeapSetup, funnel.solid, "funnel solid", 0.0, not_a_number);
  SCREE_REFUSES(FlankSetup, azimuths, "flank azimuths", 7U);
  SCREE_REFUSES(FlankSetup, from, "flank from", -0.1, 0.95, not_a_number);
  SCREE_REFUSES(FlankSetup, to, "flank to", 0.15, 1.1, not_a_number);
  SCREE_REFUSES(FlankSetup, spacing, "flank spacing", 0.0, 11.0, not_a_number);
}

TEST_CASE("drop and tilt tests refuse what is out of range") {
  SCREE_REFUSES(DropTestSetup, drops, "drop test drops", 1U);
  SCREE_REFUSES(DropTestSetup, patience, "drop test patience", 0.0, not_a_number);
  SCREE_REFUSES(DropTestSetup, speeds.front(), "drop test speeds", 0.0, -1.0, not_a_number);
  SCREE_REFUSES(TiltTestSetup, rocks, "tilt test rocks", 1U);
  SCREE_REFUSES(TiltTestSetup, rate, "tilt test rate", 0.0, not_a_number);
  SCREE_REFUSES(TiltTestSetup, steepest, "tilt test steepest", 0.0, 91.0, not_a_number);
  SCREE_REFUSES(TiltTestSetup, moved, "tilt test moved", 0.0, not_a_number);
  SCREE_REFUSES(TiltTestSetup, onset_speed, "tilt test onset_speed", 0.0, not_a_number);
  SCREE_REFUSES(TiltTestSetup, rolled, "tilt test rolled", 0.0, 181.0, not_a_number);
  SCREE_REFUSES(TiltTestSetup, points, "tilt test points", 9U);
  SCREE_REFUSES(TiltTestSetup, tray.length, "tray length", 0.0, not_a_number);
  SCREE_REFUSES(TiltTestSetup, tray.width, "tray width", 0.0, not_a_number);
  SCREE_REFUSES(TiltTestSetup, tray.depth, "tray depth", 0.0, not_a_number);
}

TEST_CASE("gear, watch and rest refuse what is out of range") {
  SCREE_REFUSES(Gear, rope_stiffness, "gear rope_stiffness", 0.0, not_a_number);
  SCREE_REFUSES(Gear, bucket_mass, "gear bucket_mass", 0.0, not_a_number);
  SCREE_REFUSES(Gear, bucket_inertia, "gear bucket_inertia", 0.0, not_a_number);
  SCREE_REFUSES(Gear, floor_depth, "gear floor_depth", 0.0, not_a_number);
  SCREE_REFUSES(Gear, load_cell_gain, "gear load_cell_gain", 0.0, not_a_number);
  SCREE_REFUSES(Gear, load_cell_offset, "gear load_cell_offset", -1e10, 1e10, not_a_number);
  SCREE_REFUSES(SaneBounds, overlap, "watch overlap", 0.0, not_a_number);
  SCREE_REFUSES(SaneBounds, speed, "watch speed", 0.0, not_a_number);
  SCREE_REFUSES(SaneBounds, kinetic_energy, "watch kinetic_energy", 0.0, not_a_number);
  SCREE_REFUSES(SaneBounds, rope_strain, "watch rope_strain", 0.0, not_a_number);
  SCREE_REFUSES(SaneBounds, rope_slack, "watch rope_slack", 0.0, not_a_number);
  SCREE_REFUSES(SaneBounds, interval, "watch interval", 0U);
  SCREE_REFUSES(RestingRegions, speed, "rest.speed", -1.0, not_a_number, infinite);
  SCREE_REFUSES(RestingRegions, force, "rest.force", 0.0, 1.5, not_a_number);
  SCREE_REFUSES(RestingRegions, interval, "rest.interval", 0U);
  SCREE_REFUSES(RestingRegions, window, "rest.window", 0U, 501U);
}
