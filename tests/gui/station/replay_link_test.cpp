#include "gui/link/replay_link.h"

#include <QBuffer>
#include <QImage>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>

#include <gtest/gtest.h>

#include "common/record/foxglove.h"
#include "common/record/record_writer.h"
#include "common/record/run_topics.h"
#include "common/record/schema.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "gui/models/station_models.h"
#include "gui/panels/fire/thermal_tile.h"
#include "gui/views/camera/camera_tile.h"
#include "gui/views/log/log_view.h"
#include "gui/views/timeline/timeline_view.h"
#include "tests/support/data_dir.h"

namespace kiln::gui {
namespace {

constexpr int kPatience_ms = 5000;
constexpr double kStart_s = 100.0;
constexpr int kStatuses = 601;  // a minute at 10 Hz

Stamp at(double s) { return Stamp{fromSeconds(s)}; }

std::vector<std::uint8_t> smallJpeg() {
  QImage picture(8, 8, QImage::Format_RGB888);
  picture.fill(Qt::gray);
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  EXPECT_TRUE(picture.save(&buffer, "JPEG"));
  const QByteArray& bytes = buffer.data();
  return {bytes.begin(), bytes.end()};
}

/// One minute of statuses whose sequence number is the tenth of a second since the start.
class ReplayLinkTest : public ::testing::Test {
 protected:
  ReplayLinkTest() {
    auto writer = RecordWriter::create(file());
    EXPECT_TRUE(writer) << writer.error();
    EXPECT_TRUE((*writer)->attach(std::string(run::kRunAttachment), "application/json",
                                  R"({"robot_name": "Bob"})", at(kStart_s)));
    const auto channel = (*writer)->addChannel(run::topicName(Topic::RobotStatus),
                                               *protobufSchema("kiln.v1.RobotStatus"));
    EXPECT_TRUE(channel) << channel.error();
    const auto log =
        (*writer)->addChannel(run::topicName(Topic::Log), *protobufSchema("kiln.v1.LogBatch"));
    EXPECT_TRUE(log) << log.error();
    const auto thermal = (*writer)->addChannel(run::topicName(Topic::Thermal),
                                               *protobufSchema("kiln.v1.ThermalFrame"));
    EXPECT_TRUE(thermal) << thermal.error();
    const auto camera = (*writer)->addChannel(run::topicName(Topic::OperatorCamera),
                                              *protobufSchema("foxglove.CompressedImage"));
    EXPECT_TRUE(camera) << camera.error();
    const std::vector<std::uint8_t> jpeg = smallJpeg();
    for (int i = 0; i < kStatuses; ++i) {
      if (i >= 300) {  // pictures from 30 s on
        const Stamp stamp = at(kStart_s + 0.1 * i);
        const ThermalImage image{stamp, static_cast<std::uint64_t>(i), 0, 2, 1, {30000, 30100}};
        EXPECT_TRUE((*writer)->write(*thermal, stamp, stamp, wire::encode(image)));
        const JpegImage picture{stamp, static_cast<std::uint64_t>(i), "operator_camera", 8, 8,
                                jpeg};
        EXPECT_TRUE((*writer)->write(*camera, stamp, stamp, foxglove::encode(picture)));
      }
      if (i % 100 == 50) {  // at 5 s, 15 s, ...
        const Stamp stamp = at(kStart_s + 0.1 * i);
        const LogBatch batch{{{stamp, 2, "mission", std::to_string(i)}}};
        EXPECT_TRUE((*writer)->write(*log, stamp, stamp, wire::encode(batch)));
      }
      RobotStatus status;
      status.stamp = at(kStart_s + 0.1 * i);
      status.seq = static_cast<std::uint64_t>(i);
      status.environment = Environment::Sim;
      status.word = StatusWord::Auto;
      status.stop.latched = i >= 200 && i < 300;  // from 20 s to 30 s
      status.stop.source = "Ann";
      status.X_map_base.x_m = 0.05 * i;
      EXPECT_TRUE((*writer)->write(*channel, status.stamp, status.stamp, wire::encode(status)));
    }
    EXPECT_TRUE((*writer)->close());
    auto opened = ReplayLink::open(file());
    EXPECT_TRUE(opened) << opened.error();
    link = std::move(*opened);
    models = std::make_unique<StationModels>(*link);
  }
  ~ReplayLinkTest() override { link->close(); }
  [[nodiscard]] std::string file() const { return folder.filePath("run.mcap").toStdString(); }
  [[nodiscard]] std::uint64_t seq() const {
    return models->status.status() ? models->status.status()->seq : 0;
  }
  QTemporaryDir folder;
  std::unique_ptr<ReplayLink> link;
  std::unique_ptr<StationModels> models;
};

TEST_F(ReplayLinkTest, PlaysAsAReplayAndCannotBeCommanded) {
  link->open();
  ASSERT_TRUE(QTest::qWaitFor([&] { return models->status.hasData(); }, kPatience_ms));
  EXPECT_EQ(models->status.status()->environment, Environment::Replay);
  QString why;
  EXPECT_FALSE(models->mayCommand(&why));
  EXPECT_TRUE(why.contains("recording")) << why.toStdString();
  const auto nonce = models->commands.send(Pause{}, "pause");
  EXPECT_EQ(models->commands.find(nonce)->state, CommandState::NotSent);
}

TEST_F(ReplayLinkTest, AJumpShowsThatMomentAndNothingGrowsOldWhilePaused) {
  link->open();
  link->setPlaying(false);
  link->seek(at(kStart_s + 40.0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return seq() == 400; }, kPatience_ms)) << seq();
  EXPECT_EQ(models->status.ageLevel(), AgeLevel::Fresh);
  EXPECT_EQ(models->status.word(), StatusWord::Auto);
  link->seek(at(kStart_s + 10.0));  // back as well
  ASSERT_TRUE(QTest::qWaitFor([&] { return seq() == 100; }, kPatience_ms)) << seq();
  link->step(0.1);
  ASSERT_TRUE(QTest::qWaitFor([&] { return seq() == 101; }, kPatience_ms)) << seq();
  EXPECT_FALSE(link->playback().playing);
  link->step(-0.2);
  ASSERT_TRUE(QTest::qWaitFor([&] { return seq() == 99; }, kPatience_ms)) << seq();
}

TEST_F(ReplayLinkTest, AfterAJumpBackTheLogHoldsNothingOfLater) {
  Theme theme;
  const LogView view({theme, link->clock()}, *models);
  link->open();
  link->setSpeed(ReplayLink::kFastest);
  const auto lines = [&] { return view.toPlainText().count("mission:"); };
  ASSERT_TRUE(QTest::qWaitFor([&] { return lines() >= 2; }, kPatience_ms)) << "15 s are over";
  link->setPlaying(false);
  link->seek(at(kStart_s + 10.0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return seq() == 100 && lines() == 1; }, kPatience_ms))
      << view.toPlainText().toStdString();
  EXPECT_TRUE(view.toPlainText().contains("mission: 50")) << view.toPlainText().toStdString();
  for (const LogLine& line : models->log.lines()) EXPECT_LE(line.stamp, at(kStart_s + 10.0));
}

TEST_F(ReplayLinkTest, AJumpToBeforeTheFirstPictureShowsNoneOfLater) {
  Theme theme;
  const ThermalTile thermal_tile({theme, link->clock()}, *models);
  const CameraTile camera_tile({theme, link->clock()}, *models);
  link->open();
  link->setPlaying(false);
  for (int round = 0; round < 3; ++round) {
    link->seek(at(kStart_s + 40.0));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return seq() == 400 && models->thermal.image() && models->camera.image(); },
        kPatience_ms))
        << round;
    link->seek(at(kStart_s + 20.0));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return seq() == 200 && !models->thermal.hasData() && !models->camera.hasData(); },
        kPatience_ms))
        << round;
    EXPECT_EQ(models->thermal.image(), nullptr);
    EXPECT_EQ(models->camera.image(), nullptr);
  }
  link->seek(at(kStart_s + 31.0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return models->thermal.hasData(); }, kPatience_ms));
  EXPECT_EQ(models->thermal.ageLevel(), AgeLevel::Fresh);
}

// The models forget at a jump. What comes of the new time must come after that, or it is forgotten
// as well, and in a recording that stands nothing follows.
TEST_F(ReplayLinkTest, WhatComesAfterAJumpIsNotForgottenWithIt) {
  link->open();
  link->setPlaying(false);
  for (int i = 0; i < 60; ++i) {
    const int to = (i * 211) % 600;
    link->seek(at(kStart_s + 0.1 * to));
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
          return static_cast<int>(seq()) == to && !models->scene.driven().empty() &&
                 std::abs(models->scene.driven().back().x_m - 0.05 * to) < 1e-6;
        },
        kPatience_ms))
        << "jump " << i << " to " << to;
    EXPECT_EQ(models->status.ageLevel(), AgeLevel::Fresh);
  }
}

TEST_F(ReplayLinkTest, TheWholeRunIsOnTheTimeLineWhereverItStands) {
  Theme theme;
  TimelineView view({theme, link->clock()}, *models);
  view.resize(1200, 200);
  link->open();
  link->setPlaying(false);
  const auto end = [&] { return models->history.run().end(); };
  ASSERT_TRUE(QTest::qWaitFor([&] { return models->history.whole() && end() == at(kStart_s + 60); },
                              kPatience_ms));
  for (const double to : {40.0, 5.0, 55.0}) {
    link->seek(at(kStart_s + to));
    ASSERT_TRUE(QTest::qWaitFor([&] { return seq() == static_cast<std::uint64_t>(10 * to); },
                                kPatience_ms));
    const auto& stop = models->history.run().lane(RunHistory::Stop);
    ASSERT_EQ(stop.size(), 1U);
    EXPECT_EQ(stop[0].from, at(kStart_s + 20));
    EXPECT_NEAR(view.axis().xOf(at(kStart_s)), view.axis().plot.left(), 1e-6);
    EXPECT_NEAR(view.axis().xOf(at(kStart_s + 60)), view.axis().plot.right(), 1e-6);
    EXPECT_FALSE(view.valuesAt(view.axis().xOf(at(kStart_s + 25))).filter("STOP by Ann").isEmpty());
  }
  Stamp wanted;
  QObject::connect(&view, &TimelineView::seekWanted, [&](Stamp t) { wanted = t; });
  QTest::mouseClick(&view, Qt::LeftButton, {},
                    {static_cast<int>(view.axis().xOf(at(kStart_s + 30))), 20});
  EXPECT_NEAR(toSeconds(wanted - at(kStart_s + 30)), 0.0, 0.1);
}

TEST_F(ReplayLinkTest, TheSpeedIsClampedAndTheEndIsTold) {
  link->open();
  link->setSpeed(1000.0);
  link->seek(at(kStart_s + 59.0));
  ASSERT_TRUE(QTest::qWaitFor([&] { return link->playback().ended; }, kPatience_ms));
  EXPECT_EQ(link->playback().speed, ReplayLink::kFastest);
  EXPECT_EQ(seq(), 600U);
}

TEST_F(ReplayLinkTest, StopPausesARecording) {
  link->open();
  ASSERT_TRUE(QTest::qWaitFor([&] { return link->playback().playing; }, kPatience_ms));
  link->stop();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !link->playback().playing; }, kPatience_ms));
}

TEST(ReplayLink, AFileThatIsNoRecordingIsRefusedWithASentence) {
  const auto missing = ReplayLink::open("/nowhere/run.mcap");
  ASSERT_FALSE(missing.has_value());
  EXPECT_NE(missing.error().message.find("run.mcap"), std::string::npos);
}

TEST(RecordingsOnDisk, OpenOrSayWhyNot) {
  const auto cases = kiln::testing::dataFile("../cases/mcap");
  if (!cases) GTEST_SKIP() << "no cases here: set KILN_DATA_DIR";
  for (const auto& entry : std::filesystem::directory_iterator(*cases)) {
    const std::string name = entry.path().filename().string();
    const auto link = ReplayLink::open(entry.path().string());
    ASSERT_EQ(link.has_value(), name != "another_robot.mcap")
        << name << ": " << (link ? "opened" : link.error().message);
    if (!link) {
      EXPECT_NE(link.error().message.find("a recording of another robot"), std::string::npos);
      continue;
    }
    const Playback& playback = (*link)->playback();
    EXPECT_LT(toSeconds(playback.end - playback.start), 3.0) << name;
    (*link)->open();  // a damaged chunk is named when it is come to
    const bool damaged = name == "cut_half.mcap" || name == "first_chunk_damaged.mcap" ||
                         name == "one_message_at_zero.mcap";
    (void)QTest::qWaitFor(
        [&] { return playback.ended || (damaged && !playback.problem.isEmpty()); }, kPatience_ms);
    EXPECT_EQ(!playback.problem.isEmpty(), damaged) << name << playback.problem.toStdString();
    (*link)->close();
  }
}

}  // namespace
}  // namespace kiln::gui
