// A robot that was carried across the kitchen holds its mission. An operator sets its pose on the
// map and resumes, and the mission goes on to success. Both ends of the link in this process, the
// world in its own, all in lockstep: station and robot share one clock.
#include <atomic>
#include <csignal>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "robot/app/robot.h"
#include "robot/app/run_loop.h"
#include "robot/app/runtime.h"
#include "robot/evaluation/child_process.h"
#include "robot/evaluation/mission_run.h"
#include "robot/evaluation/pose_accuracy.h"
#include "robot/evaluation/scripted_operator.h"
#include "robot/evaluation/truth.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using View = ScriptedOperator::View;

constexpr const char* kKidnap = "kidnap=3,-2,90@14";
constexpr double kLimit_s = 400.0;  // of robot time

/// Where the robot comes to rest after it was carried: what a person who stands beside it sees.
std::optional<Pose2> whereItStands() {
  MissionRunOptions options;
  options.programs = binaryDir() + "/bin";
  options.world_args = {"--fault", kKidnap};
  options.robot_args = {"--until-s", "18"};
  options.trace = true;
  const auto run = runMission(options);
  EXPECT_TRUE(run.has_value()) << run.error();
  if (!run) return std::nullopt;
  const auto samples = poseSamples(*run);
  return samples.empty() ? std::nullopt : std::optional(samples.back().truth);
}

/// The whole robot of kiln-robotd in this process.
struct WholeRobot {
  WholeRobot() : scratch("carried") {}

  Result<void> start() {
    auto process = ChildProcess::start({binaryDir() + "/bin/kiln-sim", "--lockstep", "--seed", "1",
                                        "--listen", "ipc://" + scratch.file("world"), "--truth",
                                        scratch.file("truth.json"), "--fault", kKidnap},
                                       scratch.file("sim.log"));
    if (!process) return tl::make_unexpected(process.error());
    world.emplace(std::move(*process));
    DeviceSources sources;
    sources.sim = "ipc://" + scratch.file("world");
    sources.lockstep = true;
    if (auto opened = runtime.open(sources, KILN_VERSION); !opened) return opened;
    const auto file = resourcePath("config/robot.yaml");
    if (!file) return tl::make_unexpected(file.error());
    if (auto loaded = loadConfig(*file, settings); !loaded) return loaded;
    auto opened = OperatorLink::open({endpoint()}, {KILN_VERSION, Environment::Sim, "carried"},
                                     runtime.clock(), stop);
    if (!opened) return tl::make_unexpected(opened.error());
    link = std::move(*opened);
    RobotOptions options;
    options.start = options.lockstep = true;
    options.mission_uuid = "carried";
    options.version = KILN_VERSION;
    auto made = Robot::create(settings, options, runtime.devices(), runtime.clock(),
                              runtime.executor(), link.get(), stop);
    if (!made) return tl::make_unexpected(made.error());
    robot = std::move(*made);
    return {};
  }
  [[nodiscard]] std::string endpoint() const { return "ipc://" + scratch.file("link"); }
  [[nodiscard]] json truth() {
    robot.reset();
    runtime.sim.reset();  // says bye
    world->signal(SIGTERM);
    (void)world->wait(seconds(5));
    std::ifstream in(scratch.file("truth.json"));
    return json::parse(in, nullptr, false);
  }

  ScratchFolder scratch;
  std::optional<ChildProcess> world;
  Runtime runtime;
  StopLatch stop;
  RobotSettings settings;
  std::unique_ptr<OperatorLink> link;
  std::unique_ptr<Robot> robot;
};

/// What the person at the station does. @return what went wrong, or nothing.
std::string rescue(const std::string& endpoint, const Clock& clock, const Pose2& seen) {
  auto person = ScriptedOperator::connect(endpoint, "Ann", seconds(20), &clock);
  if (!person) return person.error().message;
  ScriptedOperator& ann = **person;
  const auto held = ann.waitFor("the held mission", seconds(60), [](const View& v) {
    return v.status->word == StatusWord::Paused &&
           v.status->reason.find("position lost") != std::string::npos;
  });
  if (!held) return held.error().message;
  const auto insist = [&](const CommandBody& body) {
    Result<void> done = ann.command(body);
    for (int i = 0; i < 40 && !done; ++i) {
      (void)ann.waitFor("a moment", milliseconds(50), [](const View&) { return false; });
      done = ann.command(body);
    }
    return done;
  };
  if (auto lease = insist(AcquireLease{}); !lease) return lease.error().message;
  // As somebody drags an arrow: not to the centimetre.
  if (auto set = insist(SetPose{{seen.x_m + 0.15, seen.y_m - 0.1, seen.yaw_rad + 0.07}}); !set)
    return set.error().message;
  if (auto resumed = insist(Resume{}); !resumed) return resumed.error().message;
  const auto on = ann.waitFor("the mission to go on", seconds(20),
                              [](const View& v) { return v.status->word == StatusWord::Auto; });
  return on ? std::string() : on.error().message;
}

TEST(CarriedRobot, AnOperatorSetsItsPoseAndTheMissionGoesOnToSuccess) {
  const auto seen = whereItStands();
  ASSERT_TRUE(seen.has_value());
  WholeRobot whole;
  const auto started = whole.start();
  ASSERT_TRUE(started.has_value()) << started.error();
  std::string problem;
  std::atomic<bool> failed{false};
  std::jthread person([&] {
    problem = rescue(whole.endpoint(), whole.runtime.clock(), *seen);
    if (!problem.empty()) failed = true;
  });
  const auto ran = runLockstep(*whole.runtime.sim, whole.runtime.manual_clock,
                               *whole.runtime.manual, milliseconds(8), [&] {
                                 return failed || whole.robot->missionEnded() ||
                                        toSeconds(whole.runtime.clock().now()) > kLimit_s;
                               });
  person.join();
  ASSERT_TRUE(ran.has_value()) << ran.error();
  EXPECT_EQ(problem, "");
  EXPECT_TRUE(whole.robot->missionSucceeded());
  const json truth = whole.truth();
  ASSERT_TRUE(truth.is_object());
  EXPECT_EQ(truth.at("kidnaps").size(), 1U);
  EXPECT_TRUE(truth.at("collisions").empty()) << truth.at("collisions").dump();
  EXPECT_GE(burningLitres(truth), 1.0);
}

}  // namespace
}  // namespace kiln
