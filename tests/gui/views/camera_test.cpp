#include <gtest/gtest.h>

#include "gui/views/camera/camera_feed.h"

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

}  // namespace
}  // namespace kiln::gui
