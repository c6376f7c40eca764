#include "robot/control/contact_monitor.h"

#include <random>

#include <gtest/gtest.h>

namespace kiln {
namespace {

constexpr double kDt = 0.008;

TEST(ContactMonitor, DoesNotFireOnTheSensorsNoise) {
  ContactMonitor monitor({});
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1.0);
  double worst = 0.0;
  for (int k = 0; k < 125 * 60; ++k) {
    worst = std::max(worst,
                     monitor.update({noise(random), noise(random), noise(random)}, k < 500, kDt));
  }
  EXPECT_LT(worst, 6.0);  // a minute of it
}

TEST(ContactMonitor, SeesAForceWithin80ms) {
  ContactMonitor monitor({});
  for (int k = 0; k < 250; ++k) monitor.update(Eigen::Vector3d::Zero(), true, kDt);
  int ticks = 0;
  while (monitor.update({0, 0, -100}, false, kDt) < 60.0) ++ticks;
  EXPECT_LE(ticks * kDt, 0.08);
}

TEST(ContactMonitor, LearnsAnOffsetButNotAContact) {
  ContactMonitor monitor({});
  for (int k = 0; k < 1000; ++k) monitor.update({4, -3, 0}, true, kDt);
  EXPECT_LT(monitor.force(), 0.1);
  for (int k = 0; k < 5000; ++k) monitor.update({80, 0, 0}, true, kDt);
  EXPECT_GT(monitor.force(), 69.0);  // at most 10 N are taken away
}

}  // namespace
}  // namespace kiln
