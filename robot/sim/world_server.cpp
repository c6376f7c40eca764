#include "robot/sim/world_server.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "common/core/log.h"
#include "common/transport/log_throttle.h"
#include "common/transport/zmtp_server.h"
#include "robot/sim/device_wire.h"
#include "robot/sim/picture_thread.h"
#include "robot/sim/truth_report.h"

namespace kiln::sim {
namespace {

constexpr double kIdlePoll_s = 0.1;
constexpr Duration kSlip =
    std::chrono::milliseconds(100);  // later than that the world's clock waits

/// Commands of one robot at a time, of any number that it likes; strangers get little.
ZmtpServer::Limits limits() {
  ZmtpServer::Limits out;
  out.max_peers = 16;
  out.max_queued_bytes = 64 << 20;  // reports to a robot that reads no more
  out.kept_messages_per_s = 1e6;    // in lockstep as fast as both can
  out.kept_bytes_per_s = 1e9;
  return out;
}

/// The listening socket would silently take over a file that another world listens on.
bool someoneListens(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path)) return false;
  std::memcpy(address.sun_path, path.data(), path.size());
  const int probe = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return false;
  const bool answered =
      ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  ::close(probe);
  return answered;
}

Result<void> checkEndpoint(const std::string& endpoint) {
  const bool ipc = endpoint.starts_with("ipc://") && endpoint.size() > 6;
  const bool loopback =
      endpoint.starts_with("tcp://127.0.0.1:") || endpoint.starts_with("tcp://localhost:");
  if (!ipc && !loopback) {
    return makeError(ErrorCode::InvalidInput,
                     "'{}' is no local address; without keys the world listens on ipc://PATH or "
                     "tcp://127.0.0.1:PORT only",
                     endpoint);
  }
  if (ipc && someoneListens(endpoint.substr(6))) {
    return makeError(ErrorCode::Unavailable,
                     "{} is in use by another kiln-sim; stop it or choose another address",
                     endpoint);
  }
  return {};
}

}  // namespace

struct WorldServer::Impl {
  Impl(const Config& c, World& w, const Clock& k) : config(c), world(w), clock(k) {}

  Result<void> bind();
  void onMessage(PeerId from, std::string_view bytes);
  void handle(PeerId from, const v1::device::ToWorld& message);
  void hello(PeerId from, const v1::device::Hello& message);
  void release(const char* why);
  void send(PeerId to, const v1::device::ToRobot& message);
  void publish(const WorldReport& report);
  void runLockstep(const v1::device::Advance& advance, const WorldCommands& commands);
  void runRealTime();
  [[nodiscard]] Result<void> writeTruth();
  void trace();

  Config config;
  World& world;
  const Clock& clock;
  std::unique_ptr<ZmtpServer> socket;
  PeerId holder = 0;             ///< connection of the robot, 0: none
  std::uint32_t holder_pid = 0;  ///< as it says
  LogThrottle unreadable{"sim.server"}, refused{"sim.server"}, came{"sim.server"},
      went{"sim.server"};
  void renderDue(CameraMount camera, std::unique_ptr<PictureThread>& pictures, WorldReport& report);

  std::unique_ptr<PictureThread> mast_pictures, head_pictures;
  std::ofstream trace_file;
  Stamp next_trace;
  Stamp next_report;   ///< clock time
  Duration offset{};   ///< clock - world
  Duration slipped{};  ///< how long the world has waited for this machine, in total
  std::uint64_t lost_reports = 0;
};

Result<void> WorldServer::Impl::bind() {
  if (auto ok = checkEndpoint(config.endpoint); !ok) return ok;
  auto bound = ZmtpServer::bind(config.endpoint, ZmtpKind::Router, limits());
  if (!bound) {
    return makeError(ErrorCode::Unavailable, "cannot listen on {}: {}", config.endpoint,
                     bound.error().message);
  }
  socket = std::move(*bound);
  socket->setHandlers({[this](PeerId from, std::string_view bytes) { onMessage(from, bytes); },
                       [this](PeerId peer) {
                         if (peer == holder) release("connection closed");
                       },
                       {}});
  if (!config.trace_path.empty()) {
    trace_file.open(config.trace_path, std::ios::trunc);
    if (!trace_file)
      return makeError(ErrorCode::Storage, "{}: cannot be written; check the folder and its rights",
                       config.trace_path);
  }
  return {};
}

void WorldServer::Impl::release(const char* why) {
  if (holder == 0) return;
  went.info("robot left: {}", why);
  holder = 0;
  WorldCommands nothing;
  nothing.sensors = SensorRequest{};  // sensors cost time and nobody looks
  world.command(nothing);
}

void WorldServer::Impl::send(PeerId to, const v1::device::ToRobot& message) {
  if (!socket->send(to, frameMessage({message.SerializeAsString()}))) ++lost_reports;
}

void WorldServer::Impl::publish(const WorldReport& report) {
  if (holder == 0) return;
  v1::device::ToRobot message;
  toProto(report, *message.mutable_report());
  leaveOut(config.devices, *message.mutable_report());
  send(holder, message);
}

void WorldServer::Impl::hello(PeerId from, const v1::device::Hello& m) {
  using namespace v1::device;
  ToRobot answer;
  HelloReply& reply = *answer.mutable_hello();
  const auto refuse = [&](Refusal why, std::string words) {
    reply.set_refusal(why);
    reply.set_reason(std::move(words));
    refused.warn("robot refused: {}", reply.reason());
  };
  reply.set_now_ns(toNanoseconds(world.now()));
  reply.set_lockstep(config.lockstep);
  reply.set_device_period_s(world.config().device_period_s);
  reply.set_world(world.config().name);
  reply.set_seed(world.seed());
  for (const DeviceKind device : config.devices) reply.add_devices(toProto(device));
  if (m.protocol() != PROTOCOL_CURRENT || m.version() != config.version) {
    refuse(REFUSAL_VERSION, fmt::format("the world speaks device protocol {} of version {}, the "
                                        "robot {} of {}; build both from one tree",
                                        static_cast<int>(PROTOCOL_CURRENT), config.version,
                                        m.protocol(), m.version()));
  } else if (holder != 0 && holder != from) {
    refuse(REFUSAL_BUSY, fmt::format("its robot is in use by daemon {}, another kiln-robotd; stop "
                                     "that one first",
                                     holder_pid));
  } else if (m.lockstep() != config.lockstep) {
    refuse(REFUSAL_MODE, config.lockstep
                             ? "the world runs in lockstep; start kiln-robotd with --lockstep"
                             : "the world runs in real time; start kiln-robotd without --lockstep");
  } else {
    holder = from;
    holder_pid = m.pid();
    socket->keep(from);
    reply.set_accepted(true);
    next_report = clock.now();
    came.info("robot connected at {:.3f} s", toSeconds(world.now()));
  }
  send(from, answer);
}

void WorldServer::Impl::runLockstep(const v1::device::Advance& advance,
                                    const WorldCommands& commands) {
  world.command(commands);
  const Stamp until = std::max(world.now(), stampFromNanoseconds(advance.until_ns()));
  publish(world.advance(until));
  trace();
}

void WorldServer::Impl::handle(PeerId from, const v1::device::ToWorld& m) {
  if (m.has_hello()) return hello(from, m.hello());
  if (from != holder) return;  // was refused, or has said bye
  if (m.has_bye()) {
    if (auto ok = writeTruth(); !ok) logger("sim.server")->error("{}", ok.error().message);
    return release("it said bye");
  }
  if (!m.has_advance()) return;
  auto commands = fromProto(m.advance());
  if (commands) leaveOut(config.devices, *commands);
  if (!commands) unreadable.warn("message ignored: {}", commands.error().message);
  if (config.lockstep) {
    runLockstep(m.advance(), commands.value_or(WorldCommands{}));
  } else if (commands) {
    world.command(*commands);
  }
}

void WorldServer::Impl::onMessage(PeerId from, std::string_view bytes) {
  v1::device::ToWorld message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return unreadable.warn("{}: a message of {} bytes is not of this protocol; ignored",
                           socket->nameOf(from), bytes.size());
  }
  handle(from, message);
}

void WorldServer::Impl::renderDue(CameraMount camera, std::unique_ptr<PictureThread>& pictures,
                                  WorldReport& report) {
  if (auto due = world.colourDue(camera)) {
    if (!pictures)
      pictures =
          std::make_unique<PictureThread>(world.config(), world.arena(), world.robot(), camera);
    pictures->render(std::move(*due));
  }
  if (!pictures) return;
  for (RgbImagePtr& image : pictures->finished()) report.colour.push_back(std::move(image));
}

/// One device period: the world catches up with the clock. A machine that is too slow slows the
/// world down.
void WorldServer::Impl::runRealTime() {
  const Stamp now = clock.now();
  if (now < next_report) return;
  const Duration period = fromSeconds(world.config().device_period_s);
  next_report = std::max(next_report + period, now);
  Stamp target = now - offset;
  if (target - world.now() > kSlip) {
    offset += target - world.now() - kSlip;
    slipped += target - world.now() - kSlip;
    target = world.now() + kSlip;
  }
  WorldReport report = world.advance(std::max(target, world.now()));
  renderDue(CameraMount::Mast, mast_pictures, report);
  renderDue(CameraMount::Head, head_pictures, report);
  report.slipped = slipped;
  publish(report);
  trace();
}

void WorldServer::Impl::trace() {
  if (!trace_file.is_open() || world.now() < next_trace) return;
  next_trace = world.now() + fromSeconds(1.0 / config.trace_rate_hz);
  trace_file << truthTraceLine(world.truth()) << std::flush;
}

Result<void> WorldServer::Impl::writeTruth() {
  if (config.truth_path.empty()) return {};
  return writeAtomically(config.truth_path, truthJson(world.truth()));
}

WorldServer::WorldServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WorldServer::~WorldServer() = default;

Result<std::unique_ptr<WorldServer>> WorldServer::create(const Config& config, World& world,
                                                         const Clock& clock) {
  auto impl = std::make_unique<Impl>(config, world, clock);
  if (auto ok = impl->bind(); !ok) return tl::make_unexpected(ok.error());
  return std::unique_ptr<WorldServer>(new WorldServer(std::move(impl)));
}

Result<void> WorldServer::run(const std::atomic<bool>& stop) {
  Impl& w = *impl_;
  w.offset = w.clock.now() - w.world.now();
  w.next_report = w.clock.now();
  while (!stop.load()) {
    double wait_s = std::min(kIdlePoll_s, w.socket->wait_s());
    if (!w.config.lockstep)
      wait_s = std::clamp(toSeconds(w.next_report - w.clock.now()), 0.0, wait_s);
    pollfd item{w.socket->fd(), POLLIN, 0};
    ::poll(&item, 1, static_cast<int>(std::ceil(wait_s * 1e3)));  // a signal ends it too
    w.socket->serve();
    if (!w.config.lockstep) w.runRealTime();
  }
  return w.writeTruth();
}

}  // namespace kiln::sim
