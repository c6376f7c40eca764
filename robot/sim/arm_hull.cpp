#include "robot/sim/arm_hull.h"

namespace kiln::sim {
namespace {

constexpr double kShoulder = 0.1762, kElbow = 0.0393;                      // beside the DH lines
constexpr double kBase = 0.1807, kUpper = 0.6127, kFore = 0.57155;         // |d1|, |a2|, |a3|
constexpr double kWrist1 = 0.17415, kWrist2 = 0.11985, kWrist3 = 0.11655;  // d4, d5, d6
constexpr double kUpperRadius = 0.066, kForeRadius = 0.055, kWristRadius = 0.05;
constexpr double kHoseRadius = 0.012, kHoseGap = 0.008;  // its axis, beside the link's surface

}  // namespace

const std::vector<HullPart>& armHull() {
  using enum Material;
  static const double kOuter = kShoulder + kUpperRadius + kHoseGap;
  static const double kInner = kElbow - kForeRadius - kHoseGap;
  static const std::vector<HullPart> kParts{
      {"column", 1, {0, -kBase, 0}, {0, 0, 0}, 0.095, ArmLink},
      {"shoulder", 1, {0, 0, 0}, {0, 0, kShoulder}, 0.08, ArmLink},
      {"upper arm", 2, {kUpper, 0, kShoulder}, {0, 0, kShoulder}, kUpperRadius, ArmLink},
      {"elbow", 2, {0, 0, kShoulder}, {0, 0, kElbow}, kUpperRadius, ArmLink},
      {"forearm", 3, {kFore, 0, kElbow}, {0, 0, kElbow}, kForeRadius, ArmLink},
      {"wrist 1", 4, {0, kElbow - kWrist1, 0}, {0, 0, 0}, kWristRadius, ArmLink},
      {"wrist 2", 5, {0, kWrist2, 0}, {0, 0, 0}, kWristRadius, ArmLink},
      {"wrist 3", 6, {0, 0, -kWrist3}, {0, 0, 0}, kWristRadius, ArmLink},
      {"hose on upper arm", 2, {kUpper, 0, kOuter}, {0, 0, kOuter}, kHoseRadius, Hose},
      {"hose on forearm", 3, {kFore, 0, kInner}, {0, 0, kInner}, kHoseRadius, Hose}};
  return kParts;
}

}  // namespace kiln::sim
