#include "robot/missions/fire/heat_task.h"

#include <gtest/gtest.h>

#include "common/core/manual_executor.h"

namespace kiln {
namespace {

/// The camera delivers into a heat task under a clock that stands where the test puts it.
struct Watched {
  ManualClock clock{Stamp{std::chrono::seconds(100)}};
  ManualExecutor executor{clock};
  HeatTask task{HeatTask::Config{}, executor};
  std::uint64_t seq = 0;

  void image(bool work = true, bool agc = false, bool tlinear = true) {
    auto image = std::make_shared<ThermalImage>();
    image->stamp = clock.now();
    image->seq = image->frame_counter = static_cast<std::uint32_t>(++seq);
    image->counts.assign(160 * 120, 29815);
    image->agc = agc;
    image->tlinear = tlinear;
    task.onThermal(image);
    task.dispatch();
    if (work) executor.runUntil(clock.now() + std::chrono::milliseconds(50));
    (void)task.take();
  }
  void wait(double s) { executor.runUntil(clock.now() + fromSeconds(s)); }
  [[nodiscard]] Check row(std::size_t i) const { return task.checks(clock.now()).at(i); }
};

TEST(HeatTask, ItsRowsSayThatACameraIsSilent) {
  Watched w;
  EXPECT_FALSE(w.row(0).ok);
  EXPECT_EQ(w.row(0).detail, "no data yet");
  for (int i = 0; i < 5; ++i) w.image(), w.wait(0.1);
  EXPECT_TRUE(w.row(0).ok) << w.row(0).detail;
  EXPECT_TRUE(w.row(1).ok) << w.row(1).detail;
  w.wait(2.0);
  EXPECT_FALSE(w.row(0).ok);
  EXPECT_EQ(w.row(0).name, "Thermal camera");
  EXPECT_TRUE(w.row(1).ok) << "a silent camera is its own row: " << w.row(1).detail;
}

TEST(HeatTask, ItsRowSaysThatPerceptionDoesNotDeliver) {
  Watched w;
  w.image();
  for (int i = 0; i < 40; ++i) {
    auto image = std::make_shared<ThermalImage>();
    image->stamp = w.clock.now();
    w.task.onThermal(image);
    w.task.dispatch();
    w.wait(0.1);  // its results are never taken: the pool stands still
  }
  EXPECT_TRUE(w.row(0).ok) << w.row(0).detail;
  EXPECT_FALSE(w.row(1).ok);
  EXPECT_NE(w.task.late(w.clock.now()).find("although the thermal camera delivers"),
            std::string::npos);
}

TEST(HeatTask, ARefusedPictureIsToldOnceTheShutterCannotBeTheReason) {
  Watched w;
  for (int i = 0; i < 5; ++i) w.image(), w.wait(0.1);
  ASSERT_TRUE(w.row(0).ok) << w.row(0).detail;
  --w.seq;  // the camera's own counter stands still: frozen
  const auto frozen = [&w] {
    w.image();
    --w.seq;
    w.wait(0.1);
  };
  for (int i = 0; i < 3; ++i) frozen();
  EXPECT_TRUE(w.row(0).ok) << "the shutter closes for less than a second";
  for (int i = 0; i < 20; ++i) frozen();
  EXPECT_FALSE(w.row(0).ok);
  EXPECT_NE(w.row(0).action.find("shutter"), std::string::npos);
}

TEST(HeatTask, ItsAdviceFitsTheReason) {
  Watched w;
  w.image(true, true);
  EXPECT_NE(w.row(0).detail.find("AGC is on"), std::string::npos);
  EXPECT_EQ(w.row(0).action, "switch AGC off in the camera");
  w.image(true, false, false);
  EXPECT_NE(w.row(0).detail.find("no TLinear"), std::string::npos);
  EXPECT_EQ(w.row(0).action, "switch telemetry and TLinear on in the camera");
}

TEST(HeatTask, ACameraFromTheFutureHasAWrongClock) {
  Watched w;
  auto image = std::make_shared<ThermalImage>();
  image->stamp = w.clock.now() + std::chrono::seconds(3);
  w.task.onThermal(image);
  w.task.dispatch();
  EXPECT_FALSE(w.row(0).ok);
  EXPECT_EQ(w.row(0).detail, "its clock is 3000 ms ahead");
}

}  // namespace
}  // namespace kiln
