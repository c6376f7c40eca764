#include <gtest/gtest.h>

#include "gui/views/camera/camera_feed.h"
#include "gui/views/camera/camera_tile.h"
#include "tests/gui/views/sample_world.h"
#include "tests/gui/views/station_fixture.h"

namespace kiln::gui {
namespace {

constexpr Stamp at(double seconds) { return Stamp{fromSeconds(seconds)}; }

RgbImagePtr picture(double seconds, std::uint64_t seq, int bytes = 4 * 2 * 3) {
  auto image = std::make_shared<RgbImage>();
  image->stamp = at(seconds);
  image->seq = seq;
  image->width = 4;
  image->height = 2;
  image->data.assign(static_cast<std::size_t>(bytes), 200);
  return image;
}

TEST(CameraFeed, GoesFromNothingOverLiveAndLateToStalled) {
  CameraFeed feed;
  feed.judge(at(0), -1.0);
  EXPECT_EQ(feed.state(), CameraState::NoPicture);
  feed.accept(picture(10, 1), at(10));
  feed.judge(at(10.1), 0.1);
  EXPECT_EQ(feed.state(), CameraState::Live);
  EXPECT_TRUE(feed.headline().isEmpty());
  feed.judge(at(10.31), 0.31);
  EXPECT_EQ(feed.state(), CameraState::Late);
  EXPECT_FALSE(feed.crossedOut());
  feed.judge(at(12.4), 2.4);
  EXPECT_EQ(feed.state(), CameraState::Stalled);
  EXPECT_TRUE(feed.crossedOut());
  EXPECT_TRUE(feed.headline().contains("frozen 2.4 s ago"));
}

TEST(CameraFeed, TellsPicturesOfThePastFromPicturesThatStopped) {
  CameraFeed feed;
  feed.accept(picture(7, 1), at(10));  // arrives now, but was taken 3 s ago
  feed.judge(at(10.1), 3.1);
  EXPECT_EQ(feed.state(), CameraState::Stale);
  EXPECT_TRUE(feed.headline().contains("frames arrive"));
}

TEST(CameraFeed, KeepsTheLastGoodPictureWhenDecodingFails) {
  CameraFeed feed;
  feed.accept(picture(10, 1), at(10));
  feed.accept(picture(10.1, 2, 5), at(10.1));
  feed.judge(at(10.2), 0.2);
  EXPECT_EQ(feed.state(), CameraState::DecodeFailed);
  EXPECT_EQ(feed.picture().size(), QSize(4, 2));
  feed.accept(picture(10.3, 3), at(10.3));
  feed.judge(at(10.3), 0.0);
  EXPECT_EQ(feed.state(), CameraState::Live);
}

TEST(CameraFeed, TheThreeFaultsHaveThreeTexts) {
  CameraFeed stalled, stale, broken;
  stalled.accept(picture(0, 1), at(0));
  stalled.judge(at(3), 3);
  stale.accept(picture(0, 1), at(3));
  stale.judge(at(3), 3);
  broken.accept(picture(3, 1, 0), at(3));
  broken.judge(at(3), 0);
  EXPECT_NE(stalled.headline(), stale.headline());
  EXPECT_NE(stale.headline(), broken.headline());
  EXPECT_NE(stalled.advice(), broken.advice());
}

TEST(CameraFeed, AnOldPictureOfARecordingAccusesNobody) {
  CameraFeed feed;
  feed.setRecorded(true);
  feed.accept(picture(10, 1), at(10));
  feed.judge(at(10.1), 94.5);
  EXPECT_TRUE(feed.crossedOut());
  EXPECT_EQ(feed.headline(), "recorded 94.5 s before this moment");
  EXPECT_TRUE(feed.advice().isEmpty());
}

class OneMark : public PictureMarks {
 public:
  [[nodiscard]] std::vector<PictureMark> marks() const override { return {{p_map, "here"}}; }
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();
};

TEST_F(StationTest, TheOperatorsPictureMarksAPointOfTheMap) {
  const SampleWorld world;
  CameraTile tile(ui, models);
  status.X_map_base = {1.0, 2.0, 0.5};
  feed();
  auto* mark = new OneMark;
  mark->p_map = toIsometry(status.X_map_base) * world.robot().X_base_operatorcamera.pose() *
                Eigen::Vector3d(0, 0, 3);
  tile.setMarks(mark, world.robot());
  const auto* shown = tile.findChild<CameraPicture*>();
  EXPECT_TRUE(shown->marks().empty()) << "no picture yet";
  emit link.image(world.picture(link.time.now(), 1));
  feed();
  ASSERT_EQ(shown->marks().size(), 1U);
  EXPECT_NEAR(shown->marks()[0].share.x(), 0.5, 1e-6);
  EXPECT_NEAR(shown->marks()[0].share.y(), 0.5, 1e-6);
  link.time.advanceBy(std::chrono::seconds(3));
  emit models.aged();
  EXPECT_TRUE(shown->marks().empty()) << "crossed out";
  tile.setMarks(nullptr);
}

}  // namespace
}  // namespace kiln::gui
