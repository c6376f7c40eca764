#include "robot/perception/thermal/heat_detector.h"

#include <gmock/gmock.h>

#include "tests/support/thermal_renderer.h"

namespace kiln {
namespace {

using ::testing::HasSubstr;
using testing::lookAt;
using testing::ThermalRenderer;
using testing::ThermalScene;

/// Plate in the map's origin, its axis along map X.
ThermalScene sceneFacingX() {
  ThermalScene scene;
  scene.X_map_plate.linear() << 0, 0, 1, 1, 0, 0, 0, 1,
      0;  // columns: X -> map y, Y -> map z, Z -> map x
  return scene;
}
const Eigen::Isometry3d kOnAxis = lookAt({0.9, 0, 0}, {0, 0, 0});

TEST(HeatDetector, MeasuresThePlate) {
  ThermalRenderer renderer({}, 1);
  HeatDetector detector({});
  const HeatDetections found = detector.detect(renderer.render(sceneFacingX(), kOnAxis));
  ASSERT_TRUE(found.usable) << found.refusal;
  ASSERT_EQ(found.blobs.size(), 1u);
  const HeatBlob& blob = found.blobs[0];
  EXPECT_EQ(blob.rejection, HeatRejection::None);
  EXPECT_NEAR(blob.u, 79.5, 0.05);
  EXPECT_NEAR(blob.v, 59.5, 0.05);
  EXPECT_NEAR(blob.peak_k, 400, 1.5);
  EXPECT_NEAR(blob.background_k, 298.15, 0.5);
  // f = 147.3 px: radius 147.3 * 0.075 / 0.9 = 12.28 px, area 473.5 px; the blur takes pi * 0.58^2
  // = 1 px
  EXPECT_NEAR(blob.half_max_area_px, 472.5, 4.0);
  EXPECT_NEAR(blob.u_max - blob.u_min, 24, 2);
}

TEST(HeatDetector, SubPixelShiftsMoveTheCentreAndKeepTheArea) {
  for (const double shift : {0.0, 0.3, 0.5, 0.7}) {
    ThermalRenderer renderer({.noise_k = 0, .fixed_pattern_k = 0}, 1);
    Eigen::Isometry3d X = kOnAxis;
    const double m = shift * 0.9 / renderer.camera().fx;
    X.translation() += X.linear().col(0) * m;
    const HeatDetections found = HeatDetector({}).detect(renderer.render(sceneFacingX(), X));
    ASSERT_EQ(found.blobs.size(), 1u);
    EXPECT_NEAR(found.blobs[0].u, 79.5 - shift, 0.03) << shift;
    EXPECT_NEAR(found.blobs[0].half_max_area_px, 472.5, 4.0) << shift;
  }
}

TEST(HeatDetector, ListsACoolerThingAsTooCool) {
  ThermalRenderer renderer({}, 2);
  ThermalScene scene = sceneFacingX();
  scene.discs = {{{0.0, 0.5, 0.1}, 0.12, 335.0}};  // a motor, 62 deg C
  const HeatDetections found =
      HeatDetector({}).detect(renderer.render(scene, lookAt({1.2, 0.2, 0}, {0, 0.2, 0})));
  ASSERT_EQ(found.blobs.size(), 2u);
  EXPECT_EQ(found.blobs[0].rejection, HeatRejection::None);
  EXPECT_EQ(found.blobs[1].rejection, HeatRejection::TooCool);
  EXPECT_THAT(found.blobs[1].reason, HasSubstr("threshold 75.0 deg C"));
}

TEST(HeatDetector, ColdSceneHasNoBlobs) {
  ThermalRenderer renderer({}, 3);
  ThermalScene scene = sceneFacingX();
  scene.plate_k = scene.ambient_k;
  const HeatDetections found = HeatDetector({}).detect(renderer.render(scene, kOnAxis));
  EXPECT_TRUE(found.usable);
  EXPECT_TRUE(found.blobs.empty());
}

TEST(HeatDetector, ListsACoolerCopyBesideTheSourceAsReflection) {
  ThermalRenderer renderer({}, 4);
  ThermalScene scene = sceneFacingX();
  scene.discs = {
      {{0.10, 0.0, -0.19}, 0.07, 360.0}};  // 87 deg C: above the threshold, below the plate
  const HeatDetections found = HeatDetector({}).detect(renderer.render(scene, kOnAxis));
  ASSERT_EQ(found.blobs.size(), 2u);
  EXPECT_EQ(found.blobs[0].rejection, HeatRejection::None);
  EXPECT_NEAR(found.blobs[0].v, 59.5, 0.5);
  EXPECT_EQ(found.blobs[1].rejection, HeatRejection::Reflection);
  EXPECT_THAT(found.blobs[1].reason, HasSubstr("reflection"));
}

TEST(HeatDetector, FlickeringSourceIsAFlameAndASteadyOneIsNot) {
  ThermalRenderer renderer({}, 5);
  HeatDetector detector({});
  ThermalScene scene = sceneFacingX();
  HeatDetections found;
  for (int i = 0; i < 8; ++i) {
    scene.discs = {{{0.1, 0.45, 0.0}, 0.06, i % 2 == 0 ? 365.0 : 385.0}};
    found = detector.detect(renderer.render(scene, lookAt({1.2, 0.2, 0}, {0, 0.2, 0})));
  }
  ASSERT_EQ(found.blobs.size(), 2u);
  EXPECT_NEAR(found.blobs[0].peak_k, 400, 2);
  EXPECT_EQ(found.blobs[0].rejection, HeatRejection::None);
  EXPECT_EQ(found.blobs[1].rejection, HeatRejection::Flame);
}

TEST(HeatDetector, SweepPastThePlateIsNoFlicker) {
  ThermalRenderer renderer({}, 6);
  HeatDetector detector({});
  for (int i = -12; i <= 12; ++i) {  // the plate enters at one edge and leaves at the other
    const HeatDetections found =
        detector.detect(renderer.render(sceneFacingX(), lookAt({0.9, 0, 0}, {0, 0.05 * i, 0})));
    for (const HeatBlob& blob : found.blobs) EXPECT_NE(blob.rejection, HeatRejection::Flame) << i;
  }
}

TEST(HeatDetector, TinySourceIsTooSmall) {
  ThermalRenderer renderer({}, 7);
  ThermalScene scene = sceneFacingX();
  scene.plate_k = scene.ambient_k;
  scene.discs = {{{0, 0, 0}, 0.008, 600.0}};  // 2.6 px across at 0.9 m
  HeatDetector::Config config;
  config.min_area_px = 12;
  const HeatDetections found = HeatDetector(config).detect(renderer.render(scene, kOnAxis));
  ASSERT_EQ(found.blobs.size(), 1u);
  EXPECT_EQ(found.blobs[0].rejection, HeatRejection::TooSmall);
}

TEST(HeatDetector, RefusesFramesThatAreNoTemperatures) {
  ThermalRenderer renderer({}, 8);
  HeatDetector detector({});
  ThermalImage agc = renderer.render(sceneFacingX(), kOnAxis);
  agc.agc = true;
  EXPECT_THAT(detector.detect(agc).refusal, HasSubstr("AGC is on"));
  ThermalImage counts = renderer.render(sceneFacingX(), kOnAxis);
  counts.tlinear = false;
  EXPECT_THAT(detector.detect(counts).refusal, HasSubstr("no TLinear telemetry"));
  ThermalImage cut = renderer.render(sceneFacingX(), kOnAxis);
  cut.counts.resize(100);
  EXPECT_THAT(detector.detect(cut).refusal, HasSubstr("has 100 values for 160 x 120 pixels"));
  ThermalImage empty;
  empty.width = empty.height = 0;
  EXPECT_FALSE(detector.detect(empty).usable);
  for (const HeatDetections& refused : {detector.detect(agc), detector.detect(counts)}) {
    EXPECT_FALSE(refused.usable);
    EXPECT_TRUE(refused.blobs.empty());
  }
}

TEST(HeatDetector, RefusesAFrozenCameraUntilItMovesOn) {
  ThermalRenderer renderer({}, 9);
  HeatDetector detector({});
  ThermalImage frame = renderer.render(sceneFacingX(), kOnAxis);
  EXPECT_TRUE(detector.detect(frame).usable);
  ++frame.seq;  // the host counts on, the camera does not
  const HeatDetections frozen = detector.detect(frame);
  EXPECT_FALSE(frozen.usable);
  EXPECT_THAT(frozen.refusal, HasSubstr("frame counter stands at"));
  ++frame.frame_counter;
  frame.ffc = FfcState::Running;
  EXPECT_THAT(detector.detect(frame).refusal, HasSubstr("shutter"));
  ++frame.frame_counter;
  frame.ffc = FfcState::Complete;
  EXPECT_TRUE(detector.detect(frame).usable);
}

}  // namespace
}  // namespace kiln
