#include <gtest/gtest.h>

#include "common/core/units.h"
#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "gui/models/pose_placer.h"
#include "gui/panels/fire/place_nudge.h"
#include "tests/gui/station/stepped_station.h"

namespace kiln::gui {
namespace {

using Phase = PosePlacer::Phase;

template <class T>
const T* lastSent(const SteppedStation& station) {
  for (auto it = station.link.sent().rbegin(); it != station.link.sent().rend(); ++it) {
    if (const T* found = std::get_if<T>(&*it)) return found;
  }
  return nullptr;
}

TEST(PosePlacer, NothingIsSentBeforeTheConfirmation) {
  SteppedStation station;
  PosePlacer placer(station.models);
  station.pass(1.0);
  station.takeLease();
  placer.start();
  ASSERT_EQ(placer.phase(), Phase::Armed);
  placer.press(1.0, 2.0);
  placer.drag(1.0, 3.0);
  EXPECT_NEAR(placer.pose().yaw_rad, M_PI / 2, 1e-9);
  placer.drag(1.05, 2.0);  // shorter than an arrow: keeps its heading
  EXPECT_NEAR(placer.pose().yaw_rad, M_PI / 2, 1e-9);
  EXPECT_EQ(lastSent<SetPose>(station), nullptr);
  placer.confirm();
  const auto* sent = lastSent<SetPose>(station);
  ASSERT_NE(sent, nullptr);
  EXPECT_EQ(sent->X_map_base.x_m, 1.0);
  EXPECT_EQ(sent->X_map_base.y_m, 2.0);
  EXPECT_EQ(placer.phase(), Phase::Sent);
  station.settle();
  EXPECT_EQ(placer.phase(), Phase::Idle);
  EXPECT_NEAR(station.link.robot().pose().y_m, 2.0, 1e-9);
}

TEST(PosePlacer, SaysWhyItCannotBeSet) {
  SteppedStation station;
  PosePlacer placer(station.models);
  station.pass(1.0);
  QString why;
  EXPECT_FALSE(placer.mayStart(&why));
  EXPECT_TRUE(why.contains("lease")) << why.toStdString();
  station.takeLease();
  EXPECT_TRUE(placer.mayStart());
  station.startMission();
  station.pass(0.5);
  EXPECT_FALSE(placer.mayStart(&why));
  EXPECT_TRUE(why.contains("pause")) << why.toStdString();
}

TEST(PosePlacer, ARefusalOfTheRobotIsShownAndNothingMoves) {
  SteppedStation station;
  PosePlacer placer(station.models);
  station.pass(1.0);
  station.takeLease();
  placer.start();
  placer.press(1.0, 2.0);
  station.link.robot().startMission();  // the station has not heard of it yet
  station.link.robot().advance(0.02);
  placer.confirm();
  station.settle();
  EXPECT_EQ(placer.phase(), Phase::Refused);
  EXPECT_TRUE(placer.reason().contains("pause")) << placer.reason().toStdString();
  placer.cancel();
  EXPECT_EQ(placer.phase(), Phase::Idle);
}

TEST(PosePlacer, AnArmedModeDoesNotStandForever) {
  SteppedStation station;
  PosePlacer placer(station.models);
  station.pass(1.0);
  station.takeLease();
  placer.start();
  station.pass(PosePlacer::kExpiry_s - 1.0);
  EXPECT_EQ(placer.phase(), Phase::Armed);
  station.pass(2.0);
  EXPECT_EQ(placer.phase(), Phase::Idle);
}

TEST(PosePlacer, PointsThatAreNoNumbersAreNoPose) {
  SteppedStation station;
  PosePlacer placer(station.models);
  station.pass(1.0);
  station.takeLease();
  placer.start();
  placer.press(std::nan(""), 0.0);
  EXPECT_EQ(placer.phase(), Phase::Armed);
}

/// A station that looks at a scene with one place 18.4 cm off.
struct MisplacedStation : SteppedStation {
  MisplacedStation() {
    pass(1.0);
    takeLease();
    FireSite site;
    site.places = {{"place 1", {1, 2, 1}, 0.0, false, {}}, {"place 2", {3, 4, 1}, 0.0, false, {}}};
    PlaceCheck check;
    check.place = "place 2";
    check.X_map_configured = toIsometry(Pose2{3, 4, 0});
    check.X_map_sensed = toIsometry(Pose2{3.16, 4.09, 0.05});
    check.offset_m = 0.184;
    check.verdict = PlaceVerdict::Misplaced;
    site.place_checks = {check};
    Scene scene;
    scene.detail = wire::encodeDetail(site);
    emit link.scene(std::make_shared<const Scene>(scene));
    settle();
  }
};

TEST(PlaceNudge, AMisplacedPlaceIsSelectedAndItsOffsetIsInWords) {
  MisplacedStation station;
  PlaceNudge nudge(station.models);
  emit station.models.scene.changed();
  EXPECT_EQ(nudge.misplaced(), "place 2");
  EXPECT_EQ(nudge.selected(), "place 2");
  const QString text = offsetText(*nudge.check("place 2"));
  EXPECT_EQ(text, QString::fromUtf8("18 cm off (x +16 cm, y +8.5 cm, yaw +2.9°)"));
}

TEST(PlaceNudge, TheSensedPlaceIsWishedAndSentOnce) {
  MisplacedStation station;
  PlaceNudge nudge(station.models);
  emit station.models.scene.changed();
  nudge.wishSensed();
  ASSERT_TRUE(nudge.hasWish());
  nudge.add(0.02, 0.0, 0.0);
  EXPECT_EQ(lastSent<MissionCommand>(station), nullptr);
  nudge.confirm();
  const auto* sent = lastSent<MissionCommand>(station);
  ASSERT_NE(sent, nullptr);
  EXPECT_EQ(sent->name, fire::kNudgePlace);
  EXPECT_EQ(sent->target, "place 2");
  ASSERT_EQ(sent->arguments.size(), 3u);
  EXPECT_NEAR(sent->arguments[0].value, 0.18, 1e-3)
      << "of the plate, 10 cm behind the front that was seen";
  EXPECT_NEAR(sent->arguments[2].value, 0.05 / kDeg, 1e-9);
  station.settle();
  EXPECT_FALSE(nudge.hasWish());
  EXPECT_TRUE(nudge.refusal().isEmpty());
}

TEST(PlaceNudge, StaysWithinWhatTheRobotAccepts) {
  MisplacedStation station;
  PlaceNudge nudge(station.models);
  emit station.models.scene.changed();
  for (int i = 0; i < 100; ++i) nudge.add(0.02, -0.02, 0.02);
  EXPECT_EQ(nudge.wish().x_m, 0.5);
  EXPECT_EQ(nudge.wish().y_m, -0.5);
  EXPECT_NEAR(nudge.wish().yaw_rad, 30.0 * kDeg, 1e-12);
}

TEST(PlaceNudge, ARefusalKeepsTheWish) {
  MisplacedStation station;
  PlaceNudge nudge(station.models);
  emit station.models.scene.changed();
  station.models.lease.release();
  station.settle();
  nudge.add(0.02, 0, 0);
  nudge.confirm();
  station.settle();
  EXPECT_TRUE(nudge.hasWish());
  EXPECT_FALSE(nudge.refusal().isEmpty());
}

TEST(LocalizationModel, SaysHealthAndFiguresAndGrowsOld) {
  SteppedStation station;
  station.pass(1.0);
  EXPECT_EQ(station.models.localization.summary(), QString::fromUtf8("good ±9 mm ±0.2°"));
  station.link.robot().health = LocalizationHealth::Lost;
  station.pass(0.3);
  EXPECT_EQ(station.models.localization.summary(), "lost");
  EXPECT_TRUE(station.models.localization.details().contains("set the pose"));
  station.link.setSilent(true);
  station.pass(3.5);
  EXPECT_EQ(station.models.localization.summary(), "unknown");
}

}  // namespace
}  // namespace kiln::gui
