#include "robot/missions/fire/skills/heat_watch.h"

#include <limits>

#include <gtest/gtest.h>

namespace kiln {
namespace {

struct CountingSweep final : HeatSweep {
  int begun = 0, added = 0;
  mutable int asked = 0;
  void begin() override { ++begun; }
  void add(const HeatDetections&, const Eigen::Isometry3d&, const Eigen::Vector3d&) override {
    ++added;
  }
  [[nodiscard]] std::optional<FireEstimate> estimate() const override {
    ++asked;
    return std::nullopt;
  }
};

Stamp at(double s) { return Stamp{} + fromSeconds(s); }

HeatDetections image(double s, bool heat, HeatRejection rejection = HeatRejection::None) {
  HeatDetections out;
  out.stamp = at(s);
  out.threshold_k = 348.15;
  if (heat) out.blobs.emplace_back().rejection = rejection;
  return out;
}

class HeatWatchTest : public testing::Test {
 protected:
  void see(const HeatDetections& detections) {
    watch.onDetections(detections, Eigen::Isometry3d::Identity());
  }
  CountingSweep sweep;
  HeatWatch watch{sweep};
};

TEST_F(HeatWatchTest, ListensOnlyBetweenBeginAndStop) {
  see(image(1.0, true));
  EXPECT_EQ(sweep.added, 0);
  watch.begin(Eigen::Vector3d::UnitX());
  see(image(1.1, true));
  watch.stopListening();
  see(image(1.2, true));
  EXPECT_EQ(sweep.added, 1);
  EXPECT_EQ(watch.sightings(), 1);
  EXPECT_NEAR(watch.imageAgeS(at(1.5)), 0.3, 1e-9) << "the stream is alive all the same";
}

TEST_F(HeatWatchTest, RejectedBlobsAreNoSighting) {
  watch.begin(Eigen::Vector3d::UnitX());
  see(image(1.0, true, HeatRejection::TooCool));
  see(image(1.1, true, HeatRejection::Reflection));
  EXPECT_EQ(watch.sightings(), 0);
  EXPECT_EQ(watch.looks(), 2);
  EXPECT_LT(watch.seenAgeS(at(2.0)), 0.0);
}

TEST_F(HeatWatchTest, CountsUnseenTimeInUsableImagesOnly) {
  watch.begin(Eigen::Vector3d::UnitX());
  see(image(1.0, true));
  for (int i = 1; i <= 10; ++i) see(image(1.0 + 0.1 * i, false));
  EXPECT_NEAR(watch.unseenForS(), 1.0, 1e-9);
  HeatDetections frozen = image(2.1, false);
  frozen.usable = false;
  frozen.refusal = "frozen";
  see(frozen);
  EXPECT_NEAR(watch.unseenForS(), 1.0, 1e-9);
  EXPECT_EQ(watch.lastRefusal(), "frozen");
  see(image(7.0, false));  // five seconds without images: judged by their age, not as unseen
  EXPECT_NEAR(watch.unseenForS(), 1.3, 1e-9);
  see(image(7.1, true));
  EXPECT_EQ(watch.unseenForS(), 0.0);
}

TEST_F(HeatWatchTest, RefusesAPoseThatIsNotFinite) {
  watch.begin(Eigen::Vector3d::UnitX());
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation().x() = std::numeric_limits<double>::quiet_NaN();
  watch.onDetections(image(1.0, true), X);
  EXPECT_EQ(sweep.added, 0);
}

TEST_F(HeatWatchTest, AsksForTheEstimateOnceAnImage) {
  watch.begin(Eigen::Vector3d::UnitX());
  see(image(1.0, true));
  for (int i = 0; i < 5; ++i) (void)watch.estimate();
  EXPECT_EQ(sweep.asked, 1);
  see(image(1.1, true));
  (void)watch.estimate();
  EXPECT_EQ(sweep.asked, 2);
}

}  // namespace
}  // namespace kiln
