#include "robot/sim/world_server.h"

#include <algorithm>
#include <cstring>
#include <fstream>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <zmq.hpp>

#include "common/core/log.h"
#include "robot/sim/device_wire.h"
#include "robot/sim/picture_thread.h"
#include "robot/sim/truth_report.h"

namespace kiln::sim {
namespace {

constexpr const char* kMonitor = "inproc://kiln.sim.monitor";
constexpr int kIdlePoll_ms = 100;
constexpr int kQueue = 64;  // messages; a robot that reads no more loses reports
constexpr Duration kSlip =
    std::chrono::milliseconds(100);  // later than that the world's clock waits

/// ZeroMQ would silently take over a socket file that another world listens on.
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
  void handleSocket();
  void handle(const std::string& id, int fd, const v1::device::ToWorld& message);
  void hello(const std::string& id, int fd, const v1::device::Hello& message);
  void noticeDisconnects();
  void release(const char* why);
  void send(const std::string& id, const v1::device::ToRobot& message);
  void publish(const WorldReport& report);
  void runLockstep(const v1::device::Advance& advance, const WorldCommands& commands);
  void runRealTime();
  [[nodiscard]] Result<void> writeTruth();
  void trace();

  Config config;
  World& world;
  const Clock& clock;
  zmq::context_t context{1};
  zmq::socket_t socket{context, zmq::socket_type::router};
  zmq::socket_t monitor{context, zmq::socket_type::pair};
  std::string holder;  ///< routing id of the robot, empty: none
  int holder_fd = -1;
  std::unique_ptr<PictureThread> pictures;
  std::ofstream trace_file;
  Stamp next_trace;
  Stamp next_report;   ///< clock time
  Duration offset{};   ///< clock - world
  Duration slipped{};  ///< how long the world has waited for this machine, in total
  std::uint64_t lost_reports = 0;
};

Result<void> WorldServer::Impl::bind() {
  if (auto ok = checkEndpoint(config.endpoint); !ok) return ok;
  try {
    socket.set(zmq::sockopt::linger, 200);  // ms: the last words of a world that ends
    socket.set(zmq::sockopt::sndhwm, kQueue);
    socket.set(zmq::sockopt::router_mandatory, true);
    ::zmq_socket_monitor(socket.handle(), kMonitor, ZMQ_EVENT_DISCONNECTED);
    monitor.connect(kMonitor);
    socket.bind(config.endpoint);
  } catch (const zmq::error_t& e) {
    return makeError(ErrorCode::Unavailable,
                     "cannot listen on {}: {}; stop what uses it or choose another address",
                     config.endpoint, e.what());
  }
  if (!config.trace_path.empty()) {
    trace_file.open(config.trace_path, std::ios::trunc);
    if (!trace_file)
      return makeError(ErrorCode::Storage, "{}: cannot be written; check the folder and its rights",
                       config.trace_path);
  }
  return {};
}

void WorldServer::Impl::release(const char* why) {
  if (holder.empty()) return;
  logger("sim.server")->info("robot left: {}", why);
  holder.clear();
  holder_fd = -1;
  WorldCommands nothing;
  nothing.sensors = SensorRequest{};  // sensors cost time and nobody looks
  world.command(nothing);
}

void WorldServer::Impl::noticeDisconnects() {
  zmq::message_t event, address;
  while (monitor.recv(event, zmq::recv_flags::dontwait)) {
    (void)monitor.recv(address, zmq::recv_flags::none);
    std::int32_t fd = -1;  // event: 16 bit number, 32 bit value
    std::memcpy(&fd, event.data<char>() + 2, sizeof(fd));
    if (!holder.empty() && fd == holder_fd) release("connection closed");
  }
}

void WorldServer::Impl::send(const std::string& id, const v1::device::ToRobot& message) {
  zmq::message_t body(message.ByteSizeLong());
  message.SerializeWithCachedSizesToArray(body.data<std::uint8_t>());
  try {
    if (!socket.send(zmq::buffer(id), zmq::send_flags::sndmore | zmq::send_flags::dontwait)) {
      ++lost_reports;
      return;
    }
    (void)socket.send(body, zmq::send_flags::dontwait);
  } catch (const zmq::error_t& e) {
    if (e.num() == EHOSTUNREACH && id == holder) release("connection gone");
  }
}

void WorldServer::Impl::publish(const WorldReport& report) {
  if (holder.empty()) return;
  v1::device::ToRobot message;
  toProto(report, *message.mutable_report());
  send(holder, message);
}

void WorldServer::Impl::hello(const std::string& id, int fd, const v1::device::Hello& m) {
  using namespace v1::device;
  ToRobot answer;
  HelloReply& reply = *answer.mutable_hello();
  const auto refuse = [&](Refusal why, std::string words) {
    reply.set_refusal(why);
    reply.set_reason(std::move(words));
    logger("sim.server")->warn("robot refused: {}", reply.reason());
  };
  reply.set_now_ns(toNanoseconds(world.now()));
  reply.set_lockstep(config.lockstep);
  reply.set_device_period_s(world.config().device_period_s);
  reply.set_world(world.config().name);
  reply.set_seed(world.seed());
  if (m.protocol() != PROTOCOL_CURRENT || m.version() != config.version) {
    refuse(REFUSAL_VERSION, fmt::format("the world speaks device protocol {} of version {}, the "
                                        "robot {} of {}; build both from one tree",
                                        static_cast<int>(PROTOCOL_CURRENT), config.version,
                                        m.protocol(), m.version()));
  } else if (!holder.empty() && holder != id) {
    refuse(REFUSAL_BUSY, "another kiln-robotd drives this robot; stop it first");
  } else if (m.lockstep() != config.lockstep) {
    refuse(REFUSAL_MODE, config.lockstep
                             ? "the world runs in lockstep; start kiln-robotd with --lockstep"
                             : "the world runs in real time; start kiln-robotd without --lockstep");
  } else {
    holder = id;
    holder_fd = fd;
    reply.set_accepted(true);
    next_report = clock.now();
    logger("sim.server")->info("robot connected at {:.3f} s", toSeconds(world.now()));
  }
  send(id, answer);
}

void WorldServer::Impl::runLockstep(const v1::device::Advance& advance,
                                    const WorldCommands& commands) {
  world.command(commands);
  const Stamp until = std::max(world.now(), stampFromNanoseconds(advance.until_ns()));
  publish(world.advance(until));
  trace();
}

void WorldServer::Impl::handle(const std::string& id, int fd, const v1::device::ToWorld& m) {
  if (m.has_hello()) return hello(id, fd, m.hello());
  if (id != holder) return;  // was refused, or has said bye
  if (m.has_bye()) {
    if (auto ok = writeTruth(); !ok) logger("sim.server")->error("{}", ok.error().message);
    return release("it said bye");
  }
  if (!m.has_advance()) return;
  const auto commands = fromProto(m.advance());
  if (!commands) logger("sim.server")->warn("message ignored: {}", commands.error().message);
  if (config.lockstep) {
    runLockstep(m.advance(), commands.value_or(WorldCommands{}));
  } else if (commands) {
    world.command(*commands);
  }
}

void WorldServer::Impl::handleSocket() {
  noticeDisconnects();
  zmq::message_t id, body;
  while (socket.recv(id, zmq::recv_flags::dontwait)) {
    if (!id.more()) continue;
    (void)socket.recv(body, zmq::recv_flags::none);
    const int fd = ::zmq_msg_get(body.handle(), ZMQ_SRCFD);
    const bool last = !body.more();
    while (body.more()) (void)socket.recv(body, zmq::recv_flags::none);
    v1::device::ToWorld message;
    if (!last || !message.ParseFromArray(body.data(), static_cast<int>(body.size()))) {
      logger("sim.server")
          ->warn("message of {} bytes is not of this protocol; ignored", body.size());
      continue;
    }
    handle(id.to_string(), fd, message);
  }
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
  if (auto due = world.colourDue()) {
    if (!pictures)
      pictures = std::make_unique<PictureThread>(world.config(), world.arena(), world.robot());
    pictures->render(std::move(*due));
  }
  if (pictures) report.colour = pictures->finished();
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
  zmq::pollitem_t items[] = {{w.socket.handle(), 0, ZMQ_POLLIN, 0},
                             {w.monitor.handle(), 0, ZMQ_POLLIN, 0}};
  while (!stop.load()) {
    std::chrono::milliseconds wait{kIdlePoll_ms};
    if (!w.config.lockstep) {
      const Duration left = std::max(Duration{0}, w.next_report - w.clock.now());
      wait = std::chrono::ceil<std::chrono::milliseconds>(left);
    }
    try {
      zmq::poll(items, 2, wait);
      w.handleSocket();
    } catch (const zmq::error_t& e) {
      if (e.num() != EINTR)
        return makeError(ErrorCode::Fault, "socket {}: {}", w.config.endpoint, e.what());
    }
    if (!w.config.lockstep) w.runRealTime();
  }
  return w.writeTruth();
}

}  // namespace kiln::sim
