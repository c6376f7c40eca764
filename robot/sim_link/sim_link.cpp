#include "robot/sim_link/sim_link.h"

#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>

#include <sys/eventfd.h>
#include <unistd.h>

#include "common/core/check.h"
#include "common/core/log.h"
#include "common/core/scheduling.h"
#include "common/geom/frames.h"
#include "robot/sim_link/clock_map.h"
#include "robot/sim_link/device_codec.h"
#include "robot/sim_link/sim_devices.h"
#include "robot/sim_link/world_socket.h"

namespace kiln {
namespace {

constexpr std::chrono::milliseconds kPoll{50};
constexpr Duration kHelloAgain = std::chrono::milliseconds(500);

}  // namespace

void SimLink::Config::visit(ConfigArchive& a) {
  a.field("endpoint", endpoint, "ipc://PATH or tcp://127.0.0.1:PORT of kiln-sim");
  a.field("hello_timeout_s", hello_timeout_s, "s", 0.1, 600,
          "how long to wait for the world at the start");
  a.field("silence_s", silence_s, "s", 0.1, 60, "no report for so long: the world is lost");
  a.field("lockstep_timeout_s", lockstep_timeout_s, "s", 0.1, 3600,
          "wall time for one answer in lockstep");
}

struct SimLink::Impl {
  Impl(const Config& c, const Clock& k) : config(c), clock(k) {}
  ~Impl();

  [[nodiscard]] v1::device::Hello hello() const;
  Result<void> open();
  void welcome();
  void takeReport(const v1::device::Report& report, Duration shift);
  void run(std::stop_token stop);
  void handle(const v1::device::ToRobot& message);
  void watchSilence();
  Result<void> beginStep(Stamp until);
  Result<void> finishStep();
  [[nodiscard]] tl::unexpected<Error> gone(const char* what);
  template <class T, class Deliver>
  void deliver(const Result<T>& value, Deliver to) {
    if (value) return to(*value);
    logger("sim_link")->warn("{}", value.error().message);
  }

  Config config;
  const Clock& clock;
  WakeEvent wake;
  Outbox outbox;
  SensorSwitch sensors{outbox};
  SimArm arm{outbox, clock};
  SimDriveBase base{outbox};
  SimPumps pumps{outbox};
  SimArena arena{outbox};
  SimLidar lidar{sensors};
  SimThermalCamera thermal{sensors};
  SimOperatorCamera camera{sensors};
  SimHeadCamera head_camera{sensors};
  SimGripper gripper{outbox};
  SimStorage storage{outbox};
  World world;
  ClockMap clock_map;
  LatestValue<Stamp> last_report;  ///< daemon's clock
  LatestValue<std::string> refusal;
  std::atomic<std::int64_t> resets{-1};  ///< -1: not heard yet
  std::atomic<std::uint32_t> reconnects{0};
  Stamp last_hello, opened;
  std::unique_ptr<WorldSocket> socket;
  std::jthread io;
};

SimLink::Impl::~Impl() {
  if (io.joinable()) {
    io.request_stop();
    wake.notify();
    io.join();
  }
  if (!socket) return;
  v1::device::ToWorld bye;
  bye.mutable_bye();
  (void)socket->send(bye);
}

v1::device::Hello SimLink::Impl::hello() const {
  v1::device::Hello m;
  m.set_protocol(v1::device::PROTOCOL_CURRENT);
  m.set_lockstep(config.lockstep);
  m.set_version(config.version);
  m.set_pid(static_cast<std::uint32_t>(::getpid()));
  return m;
}

Result<void> SimLink::Impl::open() {
  auto opened_socket = WorldSocket::open(config.endpoint, config.lockstep ? nullptr : &wake);
  if (!opened_socket) return tl::make_unexpected(opened_socket.error());
  socket = std::move(*opened_socket);
  const auto reply = socket->hello(hello(), config.hello_timeout_s);
  if (!reply) {
    socket.reset();  // nothing to say bye to
    return tl::make_unexpected(reply.error());
  }
  world.name = reply->world();
  world.seed = reply->seed();
  world.device_period = fromSeconds(reply->device_period_s());
  world.now = stampFromNanoseconds(reply->now_ns());
  world.devices = devicesFromProto(*reply);
  welcome();
  if (!config.lockstep) {
    outbox.wake = [this] { wake.notify(); };
    io = std::jthread([this](std::stop_token stop) { run(stop); });
  }
  return {};
}

void SimLink::Impl::welcome() {
  opened = clock.now();
  clock_map.restart();
  outbox.setOpen(true);
}

void SimLink::Impl::takeReport(const v1::device::Report& report, Duration shift) {
  deliver(armFromProto(report, shift), [this](const ArmState& s) { arm.latest.put(s); });
  deliver(baseFromProto(report, shift), [this](const BaseState& s) { base.latest.put(s); });
  if (report.has_pumps())
    deliver(pumpsFromProto(report, shift), [this](const PumpsState& s) { pumps.latest.put(s); });
  if (report.has_gripper())
    deliver(gripperFromProto(report, shift),
            [this](const GripperState& s) { gripper.latest.put(s); });
  if (report.has_storage())
    deliver(storageFromProto(report, shift),
            [this](const StorageState& s) { storage.latest.put(s); });
  resets.store(report.resets());
  refusal.put(report.refused());
  last_report.put(config.lockstep ? stampFromNanoseconds(report.now_ns()) : clock.now());
  for (const auto& scan : report.lidar())
    deliver(cloudFromProto(scan, shift), [this](const PointCloudPtr& c) { lidar.deliver(c); });
  for (const auto& frame : report.thermal())
    deliver(thermalFromProto(frame, shift),
            [this](const ThermalImagePtr& i) { thermal.deliver(i); });
  for (const auto& frame : report.colour())
    deliver(colourFromProto(frame, frames::kOperatorCamera, shift),
            [this](const RgbImagePtr& i) { camera.deliver(i); });
  for (const auto& frame : report.head_colour())
    deliver(colourFromProto(frame, frames::kRgb, shift),
            [this](const RgbImagePtr& i) { head_camera.deliver(i); });
}

void SimLink::Impl::handle(const v1::device::ToRobot& message) {
  if (message.has_hello()) {
    if (!message.hello().accepted()) {
      logger("sim_link")->warn("kiln-sim refuses: {}", message.hello().reason());
      return;
    }
    welcome();
    ++reconnects;
    sensors.repeat();
    arena.forget();
    logger("sim_link")->info("world '{}' is back", message.hello().world());
    return;
  }
  if (!message.has_report()) return;
  clock_map.observe(clock.now(), stampFromNanoseconds(message.report().now_ns()),
                    Duration(message.report().slipped_ns()));
  takeReport(message.report(), clock_map.shift());
}

/// No report for a while: refuse commands, and knock until somebody opens.
void SimLink::Impl::watchSilence() {
  const Stamp now = clock.now();
  const Stamp heard = std::max(opened, last_report.peek().value_or(opened));
  if (outbox.open() && toSeconds(now - heard) >= config.silence_s) {
    logger("sim_link")
        ->error("no report from kiln-sim for {:.1f} s; commands are refused until it answers",
                config.silence_s);
    outbox.setOpen(false);
  }
  // A world that was only slow reports again before it has heard a hello: knock all the same, only
  // its answer opens the door.
  if (outbox.open() || now - last_hello < kHelloAgain) return;
  last_hello = now;
  v1::device::ToWorld out;
  *out.mutable_hello() = hello();
  (void)socket->send(out);
}

void SimLink::Impl::run(std::stop_token stop) {
  ::pthread_setname_np(::pthread_self(), "io.sim");
  runBeforeOthers();
  while (!stop.stop_requested()) {
    v1::device::ToWorld out;
    if (outbox.take(*out.mutable_advance())) (void)socket->send(out);
    if (const auto message = socket->receive(kPoll)) handle(*message);
    (void)socket->lost();  // silence tells the same; this empties the monitor
    watchSilence();
  }
}

Result<void> SimLink::Impl::beginStep(Stamp until) {
  KILN_CHECK(config.lockstep, "a step in real time");
  v1::device::ToWorld out;
  (void)outbox.take(*out.mutable_advance());
  out.mutable_advance()->set_until_ns(toNanoseconds(until));
  if (!outbox.open() || !socket->send(out)) return gone("is gone");
  return {};
}

Result<void> SimLink::Impl::finishStep() {
  KILN_CHECK(config.lockstep, "a step in real time");
  const int slices = std::max(1, static_cast<int>(std::lround(config.lockstep_timeout_s / 0.1)));
  for (int slice = 0; slice < slices; ++slice) {
    const auto message = socket->receive(std::chrono::milliseconds(100));
    if (message && message->has_report()) {
      takeReport(message->report(), Duration{0});
      return {};
    }
    if (socket->lost()) return gone("ended in the middle of a step");
  }
  return gone("does not answer");
}

tl::unexpected<Error> SimLink::Impl::gone(const char* what) {
  outbox.setOpen(false);
  return makeError(ErrorCode::Unavailable, "kiln-sim {}; see its output, then start both again",
                   what);
}

SimLink::SimLink(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SimLink::~SimLink() = default;

Result<std::unique_ptr<SimLink>> SimLink::connect(const Config& config, const Clock& clock) {
  auto impl = std::make_unique<Impl>(config, clock);
  if (auto ok = impl->open(); !ok) return tl::make_unexpected(ok.error());
  return std::unique_ptr<SimLink>(new SimLink(std::move(impl)));
}

Arm& SimLink::arm() { return impl_->arm; }
DriveBase& SimLink::base() { return impl_->base; }
Pumps& SimLink::pumps() { return impl_->pumps; }
Lidar& SimLink::lidar() { return impl_->lidar; }
ThermalCamera& SimLink::thermalCamera() { return impl_->thermal; }
RgbCamera& SimLink::operatorCamera() { return impl_->camera; }
RgbCamera& SimLink::headCamera() { return impl_->head_camera; }
Gripper& SimLink::gripper() { return impl_->gripper; }
Storage& SimLink::storage() { return impl_->storage; }
Arena& SimLink::arena() { return impl_->arena; }
Result<void> SimLink::beginStep(Stamp until) { return impl_->beginStep(until); }
Result<void> SimLink::finishStep() { return impl_->finishStep(); }
Result<void> SimLink::advanceTo(Stamp until) {
  if (auto begun = beginStep(until); !begun) return begun;
  return finishStep();
}
const SimLink::World& SimLink::world() const { return impl_->world; }
bool SimLink::lockstep() const { return impl_->config.lockstep; }
bool SimLink::connected() const { return impl_->outbox.open(); }
std::optional<std::uint32_t> SimLink::resets() const {
  const std::int64_t resets = impl_->resets.load();
  return resets < 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(resets));
}
std::string SimLink::refusal() const { return impl_->refusal.peek().value_or(""); }
std::uint32_t SimLink::reconnects() const { return impl_->reconnects.load(); }

std::optional<Duration> SimLink::lastReportAge() const {
  const auto last = impl_->last_report.peek();
  if (!last) return std::nullopt;
  return impl_->clock.now() - *last;
}

}  // namespace kiln
