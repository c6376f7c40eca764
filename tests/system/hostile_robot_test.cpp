// kiln-station and kilnctl, as people start them, connected to something that is no honest robot.
#include <atomic>
#include <cmath>
#include <fstream>
#include <mutex>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include "common/core/clock.h"
#include "common/transport/endpoint.h"
#include "common/transport/frame.h"
#include "common/transport/zmtp_server.h"
#include "common/wire/command.h"
#include "common/wire/fsm.h"
#include "common/wire/mission.h"
#include "common/wire/sensor.h"
#include "common/wire/telemetry.h"
#include "common/wire/world.h"
#include "robot/evaluation/child_process.h"
#include "tests/support/attacks.h"
#include "tests/support/paths.h"

namespace kiln {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr double kMostMiB = 64.0;
constexpr double kLongestGap_ms = 1500.0;  // of the window's event loop; STOP is a key of it
const std::string kMarkup = "<img src=\"/dev/zero\">\n\x1b[2J\u202e";

std::string textOf(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Listens where a robot would, answers hello and heartbeats, and publishes what it is told to.
class HostileRobot {
 public:
  explicit HostileRobot(const std::string& endpoint) {
    const auto addresses = parseEndpoint(endpoint);
    ZmtpServer::Limits limits;
    limits.max_queued_bytes = 64 << 20;
    const auto open = [&](const std::string& address, ZmtpKind kind) {
      auto server = ZmtpServer::bind(address, kind, limits);
      EXPECT_TRUE(server.has_value()) << server.error();
      return std::move(*server);
    };
    command_ = open(addresses->command, ZmtpKind::Router);
    status_ = open(addresses->status, ZmtpKind::Publisher);
    streams_ = open(addresses->streams, ZmtpKind::Publisher);
    command_->setHandlers(
        {[this](PeerId from, std::string_view bytes) { answer(from, bytes); }, {}, {}});
    status_->setHandlers({[this](PeerId from, std::string_view) { on_status_.insert(from); },
                          [this](PeerId peer) { on_status_.erase(peer); },
                          {}});
    streams_->setHandlers({[this](PeerId from, std::string_view) { on_streams_.insert(from); },
                           [this](PeerId peer) { on_streams_.erase(peer); },
                           {}});
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }

  /// At 20 Hz beside an honest status, until the next call.
  void publish(std::vector<std::pair<Topic, std::string>> messages) {
    const std::lock_guard lock(mutex_);
    messages_ = std::move(messages);
  }
  [[nodiscard]] bool watched() const { return watched_; }
  [[nodiscard]] int sent() const { return sent_; }

 private:
  void answer(PeerId from, std::string_view bytes) {
    const auto message = wire::decodeToRobot(bytes);
    if (!message) return;
    if (std::holds_alternative<Hello>(*message)) {
      HelloReply reply;
      reply.accepted = true;
      reply.reason = kMarkup;
      reply.robot_name = kMarkup + std::string(20'000, 'x');
      reply.protocol = kProtocolVersion;
      reply.mission_uuid = kMarkup;
      reply.version = kMarkup;
      send(*command_, from, wire::encode(ToStation{reply}));
    }
    if (const auto* heartbeat = std::get_if<Heartbeat>(&*message)) {
      Heartbeat back = *heartbeat;
      back.robot_receive_ns = back.robot_send_ns = toNanoseconds(clock_.now());
      send(*command_, from, wire::encode(ToStation{back}));
    }
  }
  static void send(ZmtpServer& server, PeerId to, const std::string& bytes) {
    (void)server.send(to, frameMessage({bytes}));
  }
  void send(Topic topic, const std::string& payload) {
    const TopicInfo& info = topicInfo(topic);
    const FrameHeader header{++seq_, toNanoseconds(clock_.now()), 0};
    const auto message = frameMessage({info.name, encodeFrameHeader(header), payload});
    ZmtpServer& server = info.lane == Lane::Status ? *status_ : *streams_;
    for (const PeerId peer : info.lane == Lane::Status ? on_status_ : on_streams_)
      sent_ += server.send(peer, message) ? 1 : 0;
  }
  void serve(const std::stop_token& stop) {
    Stamp next = clock_.now();
    while (!stop.stop_requested()) {
      pollfd fds[] = {
          {command_->fd(), POLLIN, 0}, {status_->fd(), POLLIN, 0}, {streams_->fd(), POLLIN, 0}};
      ::poll(fds, 3, 5);
      for (ZmtpServer* server : {command_.get(), status_.get(), streams_.get()}) server->serve();
      watched_ = !on_status_.empty() && !on_streams_.empty();
      if (clock_.now() < next) continue;
      next = clock_.now() + milliseconds(50);
      RobotStatus honest;
      honest.stamp = clock_.now();
      honest.seq = seq_;
      send(Topic::RobotStatus, wire::encode(honest));
      const std::lock_guard lock(mutex_);
      for (const auto& [topic, payload] : messages_) send(topic, payload);
    }
  }

  SteadyClock clock_;
  std::unique_ptr<ZmtpServer> command_, status_, streams_;
  std::set<PeerId> on_status_, on_streams_;
  std::uint64_t seq_ = 0;
  std::atomic<bool> watched_ = false;
  std::atomic<int> sent_ = 0;
  std::mutex mutex_;
  std::vector<std::pair<Topic, std::string>> messages_;
  std::jthread thread_;  // last: uses all of the above
};

/// What a frame header of a JPEG picture says, and nothing more.
std::vector<std::uint8_t> jpegThatClaims(int width, int height) {
  const auto high = [](int v) { return static_cast<std::uint8_t>(v >> 8); };
  const auto low = [](int v) { return static_cast<std::uint8_t>(v); };
  std::vector<std::uint8_t> jpeg{
      0xFF,        0xD8,        0xFF,       0xC0, 0, 17,   8, high(height),
      low(height), high(width), low(width), 3,    1, 0x11, 0, 2,
      0x11,        0,           3,          0x11, 0};
  jpeg.resize(1000, 0);
  return jpeg;
}

JpegImage claimed(int width, int height) {
  JpegImage image;
  image.frame = "rgb";
  image.width = width;
  image.height = height;
  image.jpeg = jpegThatClaims(width, height);
  return image;
}

FsmInfo graphOf(int states) {
  FsmInfo info;
  info.mission = kMarkup;
  info.mission_uuid = "hostile";
  info.start_state = "S0";
  for (int i = 0; i < states; ++i) {
    const std::string name = "S" + std::to_string(i);
    FsmStateInfo state;
    state.name = state.label = state.group = name;
    info.states.push_back(state);
    info.edges.push_back({name, "S" + std::to_string((i * 7 + 1) % states), false, kMarkup});
  }
  return info;
}

RobotStatus statusOfMany() {
  RobotStatus status;
  status.seq = 1;
  status.robot_name = status.reason = kMarkup + std::string(3000, 'W');
  for (int i = 0; i < 400; ++i) {
    Alarm alarm;
    alarm.id = "a" + std::to_string(i);
    alarm.text = kMarkup + std::string(500, 'W');
    status.alarms.push_back(alarm);
    status.checks.push_back({alarm.id, false, alarm.text, alarm.text, false});
    status.operators.push_back(alarm.text);
  }
  return status;
}

RobotStatus statusOfNowhere() {
  RobotStatus status;
  status.seq = 1;
  status.X_map_base = {std::nan(""), INFINITY, 1e300};
  status.twist = {std::nan(""), -INFINITY, std::nan("")};
  status.battery_v = std::nan("");
  status.speed_scale = -INFINITY;
  status.mission_elapsed_s = std::nan("");
  status.mission_limit_s = 1e300;
  return status;
}

Scene sceneOf(int items) {
  Scene scene;
  for (int i = 0; i < items; ++i) {
    SceneItem item;
    item.id = std::to_string(i);
    item.layer = kMarkup;
    item.shape = SceneItem::Shape::Text;
    item.label = kMarkup;
    item.X_map_item.translation() = Eigen::Vector3d(std::nan(""), 1e300, i);
    scene.items.push_back(item);
  }
  return scene;
}

std::string randomBytes(std::size_t n) {
  std::mt19937_64 random(n);
  std::string bytes(n, '\0');
  for (char& c : bytes) c = static_cast<char>(random());
  return bytes;
}

TEST(HostileRobot, NeitherFillsNorFreezesAWindow) {
  const ScratchFolder folder("hostile-robot");
  const std::string endpoint = "ipc://" + folder.file("link");
  HostileRobot robot(endpoint);
  const std::string out = folder.file("station.out");
  auto station = ChildProcess::start(
      {"/bin/sh", "-c",
       "exec '" + kiln::binaryDir() + "/bin/kiln-station' --flat --stall-report --connect '" +
           endpoint + "' > '" + out + "'"},
      folder.file("station.log"));
  ASSERT_TRUE(station.has_value()) << station.error();
  for (int i = 0; i < 300 && !robot.watched(); ++i) std::this_thread::sleep_for(milliseconds(50));
  ASSERT_TRUE(robot.watched()) << tailOf(folder.file("station.log"), 5);
  std::this_thread::sleep_for(seconds(3));  // it has drawn itself
  const double before_MiB = test::residentMiB(station->pid());

  MissionDetail detail;
  detail.schema = "kiln.fire.v1.HeatDetections";
  detail.data = randomBytes(900'000);
  std::vector<std::pair<Topic, std::string>> rubbish;
  for (const TopicInfo& topic : topicTable())
    rubbish.emplace_back(topic.topic, randomBytes(60'000));
  const std::vector<std::pair<std::string, std::vector<std::pair<Topic, std::string>>>> attacks{
      {"pictures that claim to be huge",
       {{Topic::HeadCamera, wire::encode(claimed(30'000, 30'000))},
        {Topic::HeadCamera, wire::encode(claimed(8000, 8000))},
        {Topic::OperatorCamera, wire::encode(claimed(65'000, 1))}}},
      {"graphs", {{Topic::FsmInfo, wire::encode(graphOf(250))}}},
      {"graphs beyond all", {{Topic::FsmInfo, wire::encode(graphOf(8000))}}},
      {"lists", {{Topic::RobotStatus, wire::encode(statusOfMany())}}},
      {"no numbers", {{Topic::RobotStatus, wire::encode(statusOfNowhere())}}},
      {"scenes", {{Topic::Scene, wire::encode(sceneOf(2000))}}},
      {"scenes beyond all", {{Topic::Scene, wire::encode(sceneOf(8000))}}},
      {"details", {{Topic::MissionStream, wire::encode(detail)}}},
      {"rubbish", rubbish},
  };
  for (const auto& [name, messages] : attacks) {
    robot.publish(messages);
    const int sent = robot.sent();
    std::this_thread::sleep_for(milliseconds(1500));
    EXPECT_GT(robot.sent(), sent + 5) << name;  // it still listens
    const double grown_MiB = test::residentMiB(station->pid()) - before_MiB;
    std::printf("%-32s memory %+.1f MiB\n", name.c_str(), grown_MiB);
    EXPECT_LE(grown_MiB, kMostMiB) << name;
    ASSERT_TRUE(station->running()) << name << "\n" << tailOf(folder.file("station.log"), 10);
  }
  robot.publish({});
  station->signal(SIGTERM);
  EXPECT_EQ(station->wait(seconds(10)), 0) << tailOf(folder.file("station.log"), 10);
  const std::string report = textOf(out);
  double worst_ms = -1.0;
  const auto at = report.find("worst gap ");
  ASSERT_NE(at, std::string::npos) << report;
  std::sscanf(report.c_str() + at, "worst gap %lf ms", &worst_ms);
  std::printf("%s", report.c_str());
  EXPECT_LE(worst_ms, kLongestGap_ms);
}

TEST(HostileRobot, IsShownInPrintableTextByKilnctl) {
  const ScratchFolder folder("hostile-robot");
  const std::string endpoint = "ipc://" + folder.file("link");
  HostileRobot robot(endpoint);
  robot.publish({{Topic::RobotStatus, wire::encode(statusOfMany())},
                 {Topic::FsmInfo, wire::encode(graphOf(8000))},
                 {Topic::RobotStatus, randomBytes(60'000)}});
  const std::string out = folder.file("kilnctl.out");
  auto kilnctl = ChildProcess::start({"/bin/sh", "-c",
                                      "exec '" + kiln::binaryDir() + "/bin/kilnctl' --connect '" +
                                          endpoint + "' state > '" + out + "' 2>&1"},
                                     folder.file("kilnctl.log"));
  ASSERT_TRUE(kilnctl.has_value()) << kilnctl.error();
  ASSERT_TRUE(kilnctl->wait(seconds(15)).has_value());
  const std::string text = textOf(out);
  EXPECT_FALSE(text.empty());
  for (const char c : text)
    ASSERT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << static_cast<int>(c);
}

}  // namespace
}  // namespace kiln
