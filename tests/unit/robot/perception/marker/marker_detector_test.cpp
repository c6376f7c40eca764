#include "robot/perception/marker/marker_detector.h"

#include <gtest/gtest.h>

#include "tests/unit/robot/perception/marker/drawn_picture.h"

namespace kiln {
namespace {

using testing::draw;
using testing::Rgb;

bool within(int u, int v, int left, int top, int width, int height) {
  return u >= left && u < left + width && v >= top && v < top + height;
}

TEST(MarkerDetector, ChequeredStripWinsByTheCornersOfBothMasks) {
  const MarkerView view = MarkerDetector({}).detect(draw([](int u, int v) {
    return within(u, v, 300, 400, 320, 64) ? testing::chequered(u - 300, v - 400, 16)
                                           : testing::kGrey;
  }));
  ASSERT_EQ(view.refused, "");
  ASSERT_EQ(view.winner, 0);
  const MarkerCluster& found = view.clusters[0];
  // 20 x 4 squares have 19 x 3 corners inside and more on the rim.
  EXPECT_GE(found.votes, 40);
  EXPECT_NEAR(found.pixels, 320 * 64, 600);
  EXPECT_NEAR(found.box.min().x(), 300, 2);
  EXPECT_NEAR(found.box.max().y(), 463, 2);
  EXPECT_LE(static_cast<int>(found.mask_pixels.size()), MarkerDetector::Config().max_pixels);
  // The outline lies where the strip ends, half a pixel beyond its last pixel's middle.
  ASSERT_FALSE(found.outline.empty());
  double worst = 0.0;
  for (const OutlinePoint& p : found.outline) {
    if (p.outward.y() > -0.99F) continue;
    worst = std::max(worst, std::abs(static_cast<double>(p.pixel.y()) - 399.5));
  }
  EXPECT_LT(worst, 0.3);
}

TEST(MarkerDetector, ColoursThatAreNotBesideEachOtherAreNothing) {
  const MarkerView view = MarkerDetector({}).detect(draw([](int u, int v) {
    if (within(u, v, 100, 300, 200, 200)) return testing::kMagentaPaint;
    if (within(u, v, 500, 300, 200, 200)) return testing::kYellowPaint;
    return testing::kGrey;
  }));
  EXPECT_EQ(view.winner, -1);
  EXPECT_TRUE(view.clusters.empty());
  // The masks still show both colours to the operator.
  EXPECT_EQ(view.mask[350 * 1280 + 150], MarkerView::kMagenta);
  EXPECT_EQ(view.mask[350 * 1280 + 550], MarkerView::kYellow);
}

TEST(MarkerDetector, TwoColoursSideBySideWithoutPatternAreRefusedWithTheReason) {
  const MarkerView view = MarkerDetector({}).detect(draw([](int u, int v) {
    if (within(u, v, 100, 300, 200, 200)) return testing::kMagentaPaint;
    if (within(u, v, 300, 300, 200, 200)) return testing::kYellowPaint;
    return testing::kGrey;
  }));
  EXPECT_EQ(view.winner, -1);
  ASSERT_FALSE(view.clusters.empty());
  EXPECT_NE(view.clusters[0].refused.find("corners"), std::string::npos)
      << view.clusters[0].refused;
}

TEST(MarkerDetector, RedAndOrangeBricksAreNoMarker) {
  const MarkerView view = MarkerDetector({}).detect(draw([](int u, int v) {
    if (!within(u, v, 200, 300, 400, 200)) return testing::kGrey;
    return ((u - 200) / 40 + (v - 300) / 20) % 2 == 0 ? testing::kRedPaint : testing::kOrangePaint;
  }));
  EXPECT_EQ(view.winner, -1);
}

TEST(MarkerDetector, MostVotesWin) {
  const MarkerView view = MarkerDetector({}).detect(draw([](int u, int v) {
    if (within(u, v, 100, 500, 64, 64)) return testing::chequered(u - 100, v - 500, 16);
    if (within(u, v, 600, 300, 480, 64)) return testing::chequered(u - 600, v - 300, 16);
    return testing::kGrey;
  }));
  ASSERT_EQ(view.winner, 0);
  EXPECT_NEAR(view.clusters[0].box.min().x(), 600, 2);
  ASSERT_EQ(view.clusters.size(), 2U);
  EXPECT_NE(view.clusters[1].refused.find("of the winner"), std::string::npos)
      << view.clusters[1].refused;
}

TEST(MarkerDetector, NothingAtTheEdgeOfThePictureIsOutline) {
  const MarkerView view = MarkerDetector({}).detect(draw([](int u, int v) {
    return v > 650 && u < 400 ? testing::chequered(u, v, 16) : testing::kGrey;
  }));
  ASSERT_EQ(view.winner, 0);
  for (const OutlinePoint& p : view.clusters[0].outline) {
    EXPECT_GT(p.pixel.x(), 1.0F);
    EXPECT_LT(p.pixel.y(), 718.0F);
  }
}

TEST(MarkerDetector, PictureOfAnotherFormatIsRefused) {
  RgbImage grey = draw([](int, int) { return testing::kGrey; }, 64, 64);
  grey.data.resize(64 * 64);
  const MarkerView view = MarkerDetector({}).detect(grey);
  EXPECT_NE(view.refused.find("4096 bytes for 64 x 64 pixels"), std::string::npos) << view.refused;
  EXPECT_EQ(view.winner, -1);
}

TEST(MarkerDetector, HueVolumeMayGoAroundThroughZero) {
  MarkerDetector::Config config;
  config.magenta = {170, 1, 100, 80};  // as the red bricks
  const MarkerView view = MarkerDetector(config).detect(draw([](int u, int v) {
    if (!within(u, v, 300, 300, 320, 64)) return testing::kGrey;
    return (u / 16 + v / 16) % 2 == 0 ? testing::kRedPaint : testing::kYellowPaint;
  }));
  EXPECT_EQ(view.winner, 0);
}

}  // namespace
}  // namespace kiln
