#include "robot/missions/wall/wall_config.h"

namespace kiln {

void PileLookConfig::visit(ConfigArchive& a) {
  a.field("distance_m", distance_m, "m", 1.5, 8, "of the base from the middle of line 1");
  a.field("settle_s", settle_s, "s", 0.2, 10, "at rest before it is judged what the scans show");
  a.field("max_looks", max_looks, "", 1, 10, "from places beside each other");
}

void BrickLookConfig::visit(ConfigArchive& a) {
  a.field("wheels_m", wheels_m, "m", 0, 0.5, "one sigma of a drive since the pile was found");
  a.field("wheels_deg", wheels_deg, "deg", 0, 10, "the same of its direction");
  a.field("level_deg", level_deg, "deg", 0, 10, "that seem to lean by no more are level");
  a.field("far_m", far_m, "m", 0.5, 20, "bricks beyond that are not asked for");
  a.field("trusted", trusted, "", 0, 1, "confidence of a brick that may be gripped");
  a.field("latency_s", latency_s, "s", 0, 5, "modelled latency in lockstep");
}

void LoadingConfig::visit(ConfigArchive& a) {
  a.field("bricks", bricks, "", 0, 100,
          "of the plan that are taken; all: and built; 0: nothing is touched");
  a.field("look_m", look_m, "m", 1.5, 5, "of the base's middle from the stack it looks at");
  a.field("reach_m", reach_m, "m", 0.5, 2, "of the base's middle from the stack it takes from");
  a.field("left_m", left_m, "m", -0.5, 0.5, "the stack, to the left of the base's middle");
  a.field("same_m", same_m, "m", 0, 0.5, "nearer to its stand the base need not drive");
  a.field("same_deg", same_deg, "deg", 0, 30, "the same of its direction");
  a.field("aside_m", aside_m, "m", 0, 0.05, "so far beside, where it met a wall of its bin");
  a.field("most_aside_m", most_aside_m, "m", 0, 0.1, "but not farther beside");
  a.field("askew_m", askew_m, "m", 0, 0.05, "and turned, its ends so far beside");
  a.field("max_tries", max_tries, "", 1, 50, "of setting a brick into its bin");
  a.field("back_s", back_s, "s", 0.5, 20, "drawn back by what the arm did that long");
  a.field("max_faults", max_faults, "", 0, 20, "of pick or store in a row");
  a.section("pick", pick, "taking a brick");
  a.section("store", store, "setting it into its bin");
  a.section("travel", travel, "the storage's compartments");
}

void BuildingConfig::visit(ConfigArchive& a) {
  a.field("distance_m", distance_m, "m", 0.5, 2, "of the base's middle from the middle of the leg");
  a.field("out_m", out_m, "m", 0.1, 0.8, "what was taken from a bin is led so far before it");
  a.field("back_s", back_s, "s", 0.5, 20, "drawn back by what the arm did that long");
  a.field("max_faults", max_faults, "", 0, 20, "of taking out, setting or looking in a row");
  a.section("take_out", take_out, "taking a brick out of its bin");
  a.section("set", set, "setting it into the wall");
}

void MarkerLookConfig::visit(ConfigArchive& a) {
  a.field("distance_m", distance_m, "m", 2, 12, "of the base from the leg of the blueprint");
  a.field("pan_deg", pan_deg, "deg", 0, 60, "the head looks to both sides by so much");
  a.field("stops", stops, "", 1, 20, "from one side to the other");
  a.field("rest_s", rest_s, "s", 0.2, 10, "at each of them; pictures of a head at rest count");
  a.field("tilt_deg", tilt_deg, "deg", 0, 80, "below the horizon, one round each");
  a.field("max_looks", max_looks, "", 1, 10, "from places beside each other");
}

void WallConfig::visit(ConfigArchive& a) {
  a.field("blueprint", blueprint, "what is to be built: a resource, or the path of a file");
  a.field("mirrored", mirrored, "its lines are drawn as seen from behind the wall");
  a.field("bottom_first", bottom_first, "its first line is the layer on the ground");
  a.section("pile_look", pile_look, "from where the pile is looked for");
  a.section("brick_look", brick_look, "where each brick of the pile lies");
  a.section("loading", loading, "how the bricks of the pile come into the storage");
  a.section("building", building, "how the bricks come out of the storage and into the wall");
  a.section("marker_look", marker_look, "from where the wall's marker is looked for");
  a.section("look", look, "sweeps of the LiDAR");
  a.section("pile", pile, "pile in the cloud");
  a.section("bricks", bricks, "bricks in the cloud");
  a.section("marker", marker, "wall marker in the head camera's pictures");
  a.section("build_order", build_order, "what one position of the base reaches");
  a.section("build_time", build_time, "what building takes, for the order of least time");
  a.section("storage", storage, "what may stand in the robot's storage");
  a.field("stow_tolerance_deg", stow_tolerance_deg, "deg", 0.1, 20, "arm counts as stowed");
  a.field("rest_s", rest_s, "s", 0, 30, "before a drive is tried once more");
  a.field("max_drive_faults", max_drive_faults, "", 0, 10, "drives that may fail in a row");
  a.field("limit_s", limit_s, "s", 60, 36000, "mission clock");
}

}  // namespace kiln
