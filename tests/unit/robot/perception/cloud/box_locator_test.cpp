#include "robot/perception/cloud/box_locator.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "common/core/units.h"
#include "tests/unit/robot/perception/cloud/scan_rig.h"

namespace kiln {
namespace {

Eigen::Isometry3d configuredFront(const FireSiteMap& site, std::size_t place) {
  const FirePlaceConfig& c = site.places[place];
  return site.front({c.plate_xyz_m[0], c.plate_xyz_m[1], c.plate_xyz_m[2]}, c.facing_deg * kDeg);
}

/// Drives up to a place as the mission does, localised to about a centimetre.
std::deque<ScanWindow::Entry> approach(ScanRig& rig, std::size_t place, std::uint64_t seed) {
  const FirePlaceConfig& c = rig.site.places[place];
  const Pose2 from = c.via.back().pose(), to = c.work_pose.pose();
  const double way = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m), speed = 0.8;
  const Vector6d q = RobotGeometry::radians(rig.robot.q_drive_deg);
  const auto motion = [&](double t) {
    const double s = std::clamp((t - 1.0) * speed / way, 0.0, 1.0);
    return ScanRig::Motion{{from.x_m + s * (to.x_m - from.x_m), from.y_m + s * (to.y_m - from.y_m),
                            from.yaw_rad + s * (to.yaw_rad - from.yaw_rad)},
                           q};
  };
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  const Pose2 bias{0.008 * normal(random), 0.008 * normal(random), 0.15 * kDeg * normal(random)};
  ScanWindow window({});
  for (double t = 1.0; t < 1.0 + way / speed + 1.0; t += 0.2) {
    const auto scan = rig.scan(t, motion);
    const ScanRig::Motion m = motion(toSeconds(scan->stamp));
    // Localised by the same LiDAR: the base is believed to be where the LiDAR says, with the
    // nominal extrinsics, so that their error is in both.
    const Eigen::Isometry3d X_base_flange = rig.robot.X_base_flange(m.q);
    Pose2 believed =
        projectToGround(toIsometry(m.X_map_base) * X_base_flange * rig.arena.robot.X_flange_lidar *
                        (X_base_flange * rig.robot.X_flange_lidar.pose()).inverse());
    believed.x_m += bias.x_m + 0.005 * normal(random);
    believed.y_m += bias.y_m + 0.005 * normal(random);
    believed.yaw_rad += bias.yaw_rad + 0.05 * kDeg * normal(random);
    window.add({std::make_shared<PointCloud>(rig.prepare(*scan, motion)), toIsometry(believed),
                X_base_flange * rig.robot.X_flange_lidar.pose()});
  }
  return window.entries();
}

int seeds() {
  const char* wanted = std::getenv("KILN_SEEDS");
  return wanted ? std::atoi(wanted) : 2;
}

TEST(BoxLocator, RefusesWhatIsMisplacedAndAcceptsTheNormalScatter) {
  std::vector<double> errors_m, errors_deg;
  int refused = 0, accepted = 0, asked = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(seeds()); ++seed) {
    ScanRig rig(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> unit;
    const BoxLocator locator{{}};
    const std::size_t place = seed % 2;
    const auto scans = approach(rig, place, seed);
    const Eigen::Isometry3d truth = rig.arena.fire_places[place].X_map_front;
    const PlaceCheck normal = locator.check("place", configuredFront(rig.site, place), scans);
    ++asked;
    accepted += normal.verdict == PlaceVerdict::Fits ? 1 : 0;
    const double d = 0.15 + 0.25 * unit(random), bearing = 2.0 * M_PI * unit(random),
                 yaw = (2.0 * unit(random) - 1.0) * 5.0 * kDeg;
    const Eigen::Isometry3d wrong =
        makePose(truth * Eigen::Vector3d(-0.1, 0, 0) +
                     d * Eigen::Vector3d(std::cos(bearing), std::sin(bearing), 0),
                 {0, 0, projectToGround(truth).yaw_rad + yaw}) *
        Eigen::Translation3d(0.1, 0, 0);  // turned about its plate
    const PlaceCheck misplaced = locator.check("place", wrong, scans);
    refused += misplaced.verdict != PlaceVerdict::Fits ? 1 : 0;
    for (const PlaceCheck* check : {&normal, &misplaced}) {
      const double off =
          check->X_map_sensed
              ? (check->X_map_sensed->translation() - truth.translation()).head<2>().norm()
              : NAN;
      const double turn = check->X_map_sensed
                              ? wrapAngle(projectToGround(*check->X_map_sensed).yaw_rad -
                                          projectToGround(truth).yaw_rad) /
                                    kDeg
                              : NAN;
      if (check->X_map_sensed) errors_m.push_back(off), errors_deg.push_back(std::abs(turn));
      if (std::getenv("KILN_SEEDS"))
        printf(
            "seed %2lu %s %-9s off %.3f true %.3f error %.1f mm %.2f deg sigma %.1f mm points %d "
            "coverage %.2f\n",
            static_cast<unsigned long>(seed), check == &normal ? "normal   " : "misplaced",
            toString(check->verdict).data(), check->offset_m,
            (check->X_map_configured.translation() - truth.translation()).head<2>().norm(),
            1e3 * off, turn, 1e3 * std::sqrt(check->covariance(0, 0)), check->points,
            check->coverage);
    }
  }
  EXPECT_EQ(accepted, asked);
  EXPECT_EQ(refused, asked);
  ASSERT_FALSE(errors_m.empty());
  for (const double error : errors_m) EXPECT_LT(error, 0.04);
  for (const double error : errors_deg) EXPECT_LT(error, 2.0);
}

}  // namespace
}  // namespace kiln
