// Alone in this file, so that a program that brings a table of its own (tests/system/toy) links the
// rest.
#include "robot/evaluation/evaluation.h"

namespace kiln {
namespace {

const EvaluationOption kWorld{"--world", "world file (default: the evaluation's own)",
                              &SweepOptions::world};
const EvaluationOption kPileWorld{
    "--world", "wall_lab: the pile of that world instead, swept by its robot with its own sensors",
    &SweepOptions::world};
const EvaluationOption kCalibratedWorld{
    "--world", "whose robot is calibrated, in a yard of its own (default: the fire's)",
    &SweepOptions::world};
const EvaluationOption kNeededCells{
    "--needed-cells",
    "with --world: cells of 2 cm that a sweep must show of a brick (default: what perception "
    "needs); more makes more sweeps",
    {}};
const EvaluationOption kLocalization{"--localization", "surfel_map, walls or odometry",
                                     &SweepOptions::localization};
const EvaluationOption kCalibrate{
    "--calibrate,!--no-calibrate",
    "calibrate the sensors of each seed's robot first (default; kept in "
    "~/.cache/kiln/calibration), or drive with nominal mountings",
    &SweepOptions::calibrate};
const EvaluationOption kBlueprint{
    "--blueprint",
    "a blueprint file instead of random ones; its orders are told brick by brick",
    {}};
const EvaluationOption kPictures{"--pictures", "of each look of 10 s (default: 12)", {}};
const EvaluationOption kOut{"--out", "where the result is written", &SweepOptions::out};

}  // namespace

const std::vector<Evaluation>& evaluations() {
  static const std::vector<Evaluation> all = {
      {"fire",
       "fire mission, one process each for world and robot, lockstep; full world, or --world of "
       "the flat one",
       evaluateFire,
       {1, 20},
       {kWorld, kLocalization, kCalibrate},
       {"fire", judgeFire}},
      {"localization",
       "believed against true pose over fire missions, and odometry alone on the same way",
       evaluateLocalization,
       {1, 5},
       {kWorld, kLocalization, kCalibrate}},
      {"relocalization",
       "50 wrong start poses a seed, up to 1 m and 20 deg off, all along a recorded mission: found "
       "again, or said to be lost?",
       evaluateRelocalization,
       {2, 5},
       {kCalibrate}},
      {"mapping",
       "the mapping drive, recorded, and the map made of it: loops, and keyframes against the "
       "truth",
       evaluateMapping,
       {1, 3}},
      {"marker",
       "pose of the wall marker from 4, 7 and 11 m on painted pictures, the paper's method beside "
       "it, "
       "and what is no whole marker",
       evaluateMarker,
       {1, 40},
       {kPictures}},
      {"fallback",
       "litres delivered by hand commands alone over the operator link, real time",
       evaluateFallback,
       {1, 1}},
      {"stop",
       "time from STOP to latched, and from lost setpoints to ramp and pumps off, real time",
       evaluateStop,
       {1, 1}},
      {"place-check",
       "is a misplaced fire box refused before the arm unfolds, and a normal one never",
       evaluatePlaceCheck,
       {1, 50}},
      {"resume",
       "fire missions whose daemon is killed (SIGKILL) and goes on with --resume: a seed's five at "
       "random moments and three on the approach to the building",
       evaluateResume,
       {1, 10}},
      {"build-order",
       "optimal, greedy and fastest build orders of 1,000 random blueprints (--seeds), or of one "
       "file, over reach windows from 0.9 to 1.5 m; no world",
       evaluateBuildOrder,
       {1, 1000},
       {kBlueprint}},
      {"bricks",
       "poses of individual bricks from synthetic sweeps before piles and walls, whole and "
       "disturbed, against their truth; the paper's own method on the same sweeps",
       evaluateBricks,
       {1, 100},
       {kPileWorld, kNeededCells, kCalibrate}},
      {"wall-survey",
       "pile, bricks and marker as the wall mission finds them in the lab's world, against the "
       "truth; nothing is touched",
       evaluateWallSurvey,
       {1, 10},
       {kCalibrate},
       {"wall", judgeWall}},
      {"lab-wall",
       "the paper's lab test: eleven bricks from the pile into the storage and into the wall, with "
       "the time that each part takes",
       evaluateLabWall,
       {1, 50},
       {kCalibrate}},
      {"calibrate",
       "finds the mounting of the sensors by moving the arm; --out FILE is for "
       "kiln-robotd --calibration",
       calibrateSensors,
       {1, 1},
       {kCalibratedWorld, kOut}},
      {"spray-calibration",
       "measures the jet in the world and writes resources/config/spray_calibration.yaml",
       calibrateSpray,
       {1, 1},
       {kOut}},
  };
  return all;
}

}  // namespace kiln
