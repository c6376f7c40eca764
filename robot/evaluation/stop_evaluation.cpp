#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

#include "common/config/resources.h"
#include "common/core/log.h"
#include "common/core/thread_executor.h"
#include "robot/app/robot.h"
#include "robot/evaluation/child_process.h"
#include "robot/evaluation/evaluation.h"
#include "robot/evaluation/scripted_operator.h"
#include "robot/sim_link/sim_link.h"

namespace kiln {
namespace {

using nlohmann::json;
using std::chrono::seconds;

constexpr int kStops = 100;
constexpr int kLosses = 5;
constexpr Duration kKeysLimit = seconds(180);  // each press waits for two statuses
constexpr Duration kSample = std::chrono::milliseconds(1);
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The robot in this process, the world in another, in real time: so the controllers can be watched
/// every millisecond on the same clock as the events.
class WatchedRobot {
 public:
  static Result<std::unique_ptr<WatchedRobot>> start() {
    auto out = std::unique_ptr<WatchedRobot>(new WatchedRobot);
    if (auto started = out->open(); !started) return tl::make_unexpected(started.error());
    return out;
  }
  ~WatchedRobot() { executor_.stop(); }
  [[nodiscard]] std::string endpoint() const { return "ipc://" + scratch_.file("link"); }
  [[nodiscard]] const ScratchFolder& scratch() const { return scratch_; }
  [[nodiscard]] const Robot& robot() const { return *robot_; }
  [[nodiscard]] Stamp now() const { return clock_.now(); }

 private:
  WatchedRobot() = default;
  Result<void> open() {
    auto world = ChildProcess::start(
        {siblingProgram("kiln-sim"), "--listen", "ipc://" + scratch_.file("world")},
        scratch_.file("sim.log"));
    if (!world) return tl::make_unexpected(world.error());
    world_ = std::make_unique<ChildProcess>(std::move(*world));
    SimLink::Config sim;
    sim.endpoint = "ipc://" + scratch_.file("world");
    sim.version = KILN_VERSION;
    auto connected = SimLink::connect(sim, clock_);
    if (!connected) return tl::make_unexpected(connected.error());
    sim_ = std::move(*connected);
    OperatorLink::Config link;
    link.endpoint = endpoint();
    auto opened = OperatorLink::open(link, {KILN_VERSION, Environment::Sim, "stop-evaluation"},
                                     clock_, stop_);
    if (!opened) return tl::make_unexpected(opened.error());
    link_ = std::move(*opened);
    const auto settings = loadResource<RobotSettings>("config/robot.yaml");
    if (!settings) return tl::make_unexpected(settings.error());
    RobotOptions options;
    options.version = KILN_VERSION;
    Devices devices{sim_->arm(), sim_->base(), &sim_->pumps(), &sim_->arena()};
    devices.lidar = &sim_->lidar();
    devices.thermal = &sim_->thermalCamera();
    devices.connected = [link = sim_.get()] { return link->connected(); };
    devices.resets = [link = sim_.get()] { return link->resets(); };
    auto robot = Robot::create(*settings, options, devices, clock_, executor_, link_.get(), stop_);
    if (!robot) return tl::make_unexpected(robot.error());
    robot_ = std::move(*robot);
    executor_.start();
    return {};
  }

  ScratchFolder scratch_{"stop"};
  SteadyClock clock_;
  StopLatch stop_;
  ThreadExecutor executor_{clock_, 2};
  std::unique_ptr<ChildProcess> world_;
  std::unique_ptr<SimLink> sim_;
  std::unique_ptr<OperatorLink> link_;
  std::unique_ptr<Robot> robot_;
};

/// Presses STOP, waits for the latch, clears it; times as the session measures them.
Result<std::vector<double>> timeStops(ScriptedOperator& person) {
  std::vector<double> latched_s;
  for (int i = 0; i < kStops; ++i) {
    person.session().stop();
    auto latched = person.waitFor("STOP to latch", seconds(2), [](const auto& v) {
      return v.stop.state == StopReport::State::Latched && v.status && v.status->stop.latched;
    });
    if (!latched) return tl::make_unexpected(latched.error());
    // The round trip bounds send -> latched from above and needs no clock estimate.
    latched_s.push_back(person.view().stop.round_trip_s);
    if (auto lease = person.command(AcquireLease{}); !lease)
      return tl::make_unexpected(lease.error());
    if (auto mine =
            person.waitFor("the lease", seconds(2), [](const auto& v) { return v.lease.mine; });
        !mine) {
      return tl::make_unexpected(mine.error());
    }
    if (auto cleared = person.command(ClearStop{person.view().status->stop.generation}); !cleared)
      return tl::make_unexpected(cleared.error());
    auto clear = person.waitFor("the cleared STOP", seconds(2),
                                [](const auto& v) { return !v.status->stop.latched; });
    if (!clear) return tl::make_unexpected(clear.error());
  }
  return latched_s;
}

/// Starts kilnctl holding a control, kills it with SIGKILL and watches until `stopped` holds.
/// @return seconds from the kill; infinity if it never stopped within 3 s.
Result<double> timeLoss(const WatchedRobot& watched, const std::vector<std::string>& held,
                        const std::function<bool()>& running,
                        const std::function<bool()>& stopped) {
  std::vector<std::string> argv{siblingProgram("kilnctl"), "--connect", watched.endpoint()};
  argv.insert(argv.end(), held.begin(), held.end());
  auto client = ChildProcess::start(argv, watched.scratch().file("kilnctl.log"));
  if (!client) return tl::make_unexpected(client.error());
  const Stamp limit = watched.now() + seconds(10);
  while (!running()) {
    if (watched.now() > limit) {
      return makeError(ErrorCode::Timeout, "kilnctl {} moved nothing: {}", held.front(),
                       tailOf(watched.scratch().file("kilnctl.log"), 4));
    }
    (void)client->wait(kSample);
  }
  (void)client->wait(seconds(1));
  const Stamp killed = watched.now();
  client->signal(SIGKILL);
  while (!stopped()) {
    if (watched.now() > killed + seconds(3)) return kNever;
    (void)client->wait(kSample);
  }
  return toSeconds(watched.now() - killed);
}

struct LossTimes {
  std::vector<double> ramp_s, pump_s;
};

Result<LossTimes> timeLosses(const WatchedRobot& watched, ScriptedOperator& person) {
  constexpr double kJog_mps = 0.2;
  LossTimes times;
  const auto leaseFree = [&] {  // a killed client holds it until it expires
    return person.waitFor("the dead client's lease to expire", seconds(10),
                          [](const auto& v) { return v.status->lease.holder_client.empty(); });
  };
  const auto speed = [&] { return std::abs(watched.robot().base().tracking().commanded.vx_mps); };
  const auto spraying = [&] { return watched.robot().pumps().tracking().duty[0] > 0.0; };
  for (int i = 0; i < kLosses; ++i) {
    if (auto freed = leaseFree(); !freed) return tl::make_unexpected(freed.error());
    double cruise = 0.0;  // the ramp has begun once the command falls below what it had settled at
    const std::string direction =
        i % 2 == 0 ? fmt::format("{}", kJog_mps) : fmt::format("-{}", kJog_mps);
    auto ramp = timeLoss(
        watched, {"jog", "base", direction, "0", "0"}, [&] { return speed() > 0.01; },
        [&] {
          cruise = std::max(cruise, speed());
          return speed() < 0.98 * cruise;
        });
    if (!ramp) return tl::make_unexpected(ramp.error());
    times.ramp_s.push_back(*ramp);
    if (auto freed = leaseFree(); !freed) return tl::make_unexpected(freed.error());
    auto pump = timeLoss(watched, {"pump", "1", "1"}, spraying, [&] { return !spraying(); });
    if (!pump) return tl::make_unexpected(pump.error());
    times.pump_s.push_back(*pump);
  }
  return times;
}

/// Clears whatever is latched and leaves the robot in Teleop with the lease free.
Result<void> readyForHands(ScriptedOperator& person) {
  if (auto freed =
          person.waitFor("the lease to be free", seconds(10),
                         [](const auto& v) { return v.status->lease.holder_client.empty(); });
      !freed) {
    return freed;
  }
  if (person.view().status->stop.latched) {
    if (auto lease = person.command(AcquireLease{}); !lease) return lease;
    if (auto cleared = person.command(ClearStop{person.view().status->stop.generation}); !cleared)
      return cleared;
  }
  if (auto over = person.takeOver(); !over) return over;
  return person.command(ReleaseLease{});
}

/// Key to latch in the station's own window, on a display of its own, with everything else drawn as
/// usual.
Result<std::vector<double>> timeKeyPresses(const WatchedRobot& watched) {
  const std::string log = watched.scratch().file("station.log");
  auto station = ChildProcess::start(
      {"/usr/bin/xvfb-run", "-a", "-s", "-screen 0 1680x1050x24", siblingProgram("kiln-station"),
       "--connect", watched.endpoint(), "--measure-stop", std::to_string(kStops)},
      log);
  if (!station) return tl::make_unexpected(station.error());
  const auto code = station->wait(kKeysLimit);
  if (code != 0) {
    return makeError(ErrorCode::Timeout, "kiln-station did not time its STOP key ({}): {}",
                     code ? fmt::format("exit status {}", *code) : "still running", tailOf(log, 4));
  }
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    const json timed = json::parse(line, nullptr, false);
    if (timed.is_object() && timed.contains("key_to_latch_s"))
      return timed["key_to_latch_s"].get<std::vector<double>>();
  }
  return makeError(ErrorCode::NotFound, "kiln-station printed no times: {}", tailOf(log, 4));
}

}  // namespace

Result<EvaluationResult> evaluateStop(const SweepOptions&) {
  setLogLevel(5);  // a hundred stops are a thousand lines
  auto watched = WatchedRobot::start();
  if (!watched) return tl::make_unexpected(watched.error());
  auto person = ScriptedOperator::connect((*watched)->endpoint(), "evaluation", seconds(10));
  if (!person) return tl::make_unexpected(person.error());
  auto latched = timeStops(**person);
  if (!latched) return tl::make_unexpected(latched.error());
  if (auto released = (*person)->command(ReleaseLease{}); !released)
    return tl::make_unexpected(released.error());
  const auto timed_keys = timeKeyPresses(**watched);
  if (!timed_keys)
    fmt::print(stderr, "key to latch not measured: {}\n", timed_keys.error().message);
  // A station that gave up may have left the robot stopped and its lease unexpired.
  if (auto ready = readyForHands(**person); !ready) return tl::make_unexpected(ready.error());
  const std::vector<double> keys = timed_keys.value_or(std::vector<double>{});
  auto losses = timeLosses(**watched, **person);
  if (!losses) return tl::make_unexpected(losses.error());

  EvaluationResult out;
  out.name = "stop";
  out.figures = {{"latch_median_s", median(*latched), "s", "", true},
                 {"latch_p99_s", quantile(*latched, 0.99), "s", "", true},
                 {"key_to_latch_median_s", median(keys), "s", "", true},
                 {"key_to_latch_p99_s", quantile(keys, 0.99), "s", "", true},
                 {"setpoint_loss_to_ramp_s", quantile(losses->ramp_s, 1.0), "s", "", true},
                 {"pump_off_s", quantile(losses->pump_s, 1.0), "s", "", true}};
  out.runs_json = json{{{"latch_s", *latched},
                        {"key_to_latch_s", keys},
                        {"ramp_s", losses->ramp_s},
                        {"pump_off_s", losses->pump_s}}}
                      .dump();
  out.notes = fmt::format(
      "{0} stops over ipc (request to acknowledgement, an upper bound of the latch); {0} presses "
      "of the key in the "
      "station's window under Xvfb (key event to acknowledgement shown); {1} clients "
      "killed with "
      "SIGKILL while jogging and spraying, worst shown; lost setpoints count from the kill, not "
      "from the last one.",
      kStops, kLosses);
  return out;
}

}  // namespace kiln
