// Random sequences of what operators, stations, links and the world may do, against the real
// authority, gate, dead-man, STOP latch, mission host and state machine under a manual clock.
// Invariants are looked at after each step; a sequence that breaks one is cut down to the shortest
// that still does and printed as a list.
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "common/core/log.h"
#include "robot/fsm/machine_of.h"
#include "robot/missions/common/mission_host.h"
#include "robot/safety/authority.h"
#include "tests/support/machine_mission.h"

namespace kiln {
namespace {

/// A mission that moves at each step of its working states, and counts its visits.
struct Toy {
  int setpoints = 0;  ///< written by the machine
  int visits = 0;
  bool finished = false;
};
class ToyWork;
class ToyRest;
class ToyDone;
template <class Derived, class Targets, class... Options>
struct ToyState : State<Toy, Derived, Targets, Options...> {
  static constexpr const char* kGroup = "toy";
  static constexpr const char* kDoc = "test";
  static constexpr const char* kConsequence = "moves";
  void arrive() override { ++this->context().visits; }
  void enter() override { ++this->context().setpoints; }
  void resume() override { this->enter(); }
};
struct ToyWork : ToyState<ToyWork, To<ToyRest, ToyDone>> {
  Transition execute() override;
};
struct ToyRest : ToyState<ToyRest, To<ToyWork>> {
  Transition execute() override {
    ++context().setpoints;
    return timeInState() > std::chrono::milliseconds(200) ? transit<ToyWork>() : stay();
  }
};
struct ToyDone : ToyState<ToyDone, To<>, Terminal<true>> {
  void enter() override {}
  Transition execute() override { return stay(); }
};
Transition ToyWork::execute() {
  ++context().setpoints;
  if (context().finished) return transit<ToyDone>();
  return timeInState() > std::chrono::milliseconds(500) ? transit<ToyRest>() : stay();
}
using ToyMachine = MachineOf<Toy, ToyWork, ToyRest, ToyDone>;

enum class Act : std::uint8_t {
  Tick,
  LinkGap,
  Stop,
  OtherStop,
  MotionWatchStop,
  ClearStop,
  ClearOldStop,
  AcquireLease,
  ReleaseLease,
  TakeOver,
  Press,
  Jog,
  OldPressJog,
  Release,
  Teleop,
  Autonomous,
  Start,
  Pause,
  Resume,
  ForceWork,
  ForceDone,
  Finish,
  PositionLost,
  PositionFound,
  NotReady,
  Ready,
  KillAndResume,
  Count
};
constexpr std::array<const char*, static_cast<std::size_t>(Act::Count)> kNames{
    "Tick",       "LinkGap",      "Stop",         "OtherStop",     "MotionWatchStop",
    "ClearStop",  "ClearOldStop", "AcquireLease", "ReleaseLease",  "TakeOver",
    "Press",      "Jog",          "OldPressJog",  "Release",       "Teleop",
    "Autonomous", "Start",        "Pause",        "Resume",        "ForceWork",
    "ForceDone",  "Finish",       "PositionLost", "PositionFound", "NotReady",
    "Ready",      "KillAndResume"};

class Desk final : public Authority::Handler {
 public:
  explicit Desk(bool start_by_itself) {
    build();
    if (start_by_itself) host_->waitForStart();
  }
  /// @return what is broken; empty: nothing.
  std::string perform(Act act) {
    const int before = toy_.setpoints;
    hand_moved_ = deliberate_ = acknowledged_ = other_stop_ = false;
    batch_.clear();
    give(act);
    tick();
    return broken(before);
  }

  [[nodiscard]] GateSituation situation(Stamp) const override {
    GateSituation found;
    found.mode = host_->mode();
    found.phase = host_->phase();
    found.stop_latched = stop_.latched();
    found.stop_generation = stop_.generation();
    found.stop_source = "x";
    found.ready = ready_ && located_;  // one of the checks
    found.position_lost = located_ ? "" : "position lost";
    found.view_age_s = 0.1;
    return found;
  }
  std::optional<CommandAck> execute(const Authority::Accepted& accepted, Stamp at) override {
    const CommandBody& body = accepted.command.body;
    if (const auto* jog = std::get_if<JogBase>(&body)) {
      hand_moved_ = hand_moved_ || jog->twist.vx_mps != 0.0;
      return {};
    }
    if (isSetpoint(body)) return {};
    if (std::holds_alternative<StartMission>(body)) host_->start(at), deliberate_ = true;
    if (std::holds_alternative<Resume>(body)) host_->resume(at), deliberate_ = true;
    if (std::holds_alternative<Pause>(body)) host_->hold(HoldReason::OperatorPause, "pause", at);
    if (const auto* change = std::get_if<ChangeState>(&body)) {
      deliberate_ = true;
      (void)host_->force(*change, "ann", at);
    }
    if (std::holds_alternative<ClearStop>(body) && std::exchange(other_stop_, false)) stopBy("Ben");
    if (const auto* clear = std::get_if<ClearStop>(&body))
      (void)host_->clearStop(clear->generation, at);
    if (const auto* mode = std::get_if<SetMode>(&body)) {
      authority_->invalidate();
      mode->mode == Mode::Teleop ? host_->enterTeleop("ann", at) : host_->leaveTeleop("ann", at);
    }
    return {};
  }
  void onReleased(const std::vector<HoldKind>&, Stamp) override {}
  void onLeaseLost(Stamp) override {}

 private:
  [[nodiscard]] Stamp now() const { return clock_.now(); }
  void send(CommandBody body, std::uint64_t press = 0, const char* client = "ann") {
    ReceivedCommand received;
    received.command.client_id = received.command.operator_name = client;
    received.command.nonce = ++nonce_;
    received.command.lease_epoch = authority_->lease(now()).epoch;
    received.command.issued = received.received = now();
    received.command.press = press;
    received.command.body = std::move(body);
    batch_.push_back(std::move(received));
  }
  void stopBy(const char* who) {
    acknowledged_ = true;
    (void)stop_.set(who, now());
    asleep_ = true;
    ended_press_ = press_;
  }
  void force(const char* to) {
    const FsmStatus seen = machine_->status(now());
    send(ChangeState{seen.state, seen.step, to});
  }
  void give(Act act) {
    switch (act) {
      case Act::Tick:
        break;
      case Act::LinkGap:
        clock_.advanceBy(std::chrono::milliseconds(400));
        ended_press_ = press_;
        break;
      case Act::Stop:
        stopBy("Ann");
        break;
      case Act::OtherStop:  // latched and acknowledged while a clear is being carried out
        send(ClearStop{stop_.generation()});
        other_stop_ = true;
        break;
      case Act::MotionWatchStop:
        stopBy("motion watch");
        break;
      case Act::ClearStop:
        send(ClearStop{stop_.generation()});
        break;
      case Act::ClearOldStop:
        send(ClearStop{stop_.generation() == 0 ? 0 : stop_.generation() - 1});
        break;
      case Act::AcquireLease:
        send(AcquireLease{});
        break;
      case Act::ReleaseLease:
        send(ReleaseLease{});
        ended_press_ = press_;
        break;
      case Act::TakeOver:
        send(AcquireLease{true}, 0, "ben");
        break;
      case Act::Press:
        ++press_;
        [[fallthrough]];
      case Act::Jog:
        send(JogBase{{0.3, 0, 0}}, press_);
        break;
      case Act::OldPressJog:
        if (press_ > 0) send(JogBase{{0.3, 0, 0}}, press_ - 1);
        break;
      case Act::Release:
        send(ReleaseAll{});
        ended_press_ = press_;
        break;
      case Act::Teleop:
        send(SetMode{Mode::Teleop});
        break;
      case Act::Autonomous:
        send(SetMode{Mode::Autonomous});
        break;
      case Act::Start:
        send(StartMission{});
        break;
      case Act::Pause:
        send(Pause{});
        break;
      case Act::Resume:
        send(Resume{});
        break;
      case Act::ForceWork:
        force("ToyWork");
        break;
      case Act::ForceDone:
        force("ToyDone");
        break;
      case Act::Finish:
        toy_.finished = !toy_.finished;
        break;
      case Act::PositionLost:
        located_ = false;
        break;
      case Act::PositionFound:
        located_ = true;
        break;
      case Act::NotReady:
        ready_ = false;
        break;
      case Act::Ready:
        ready_ = true;
        break;
      case Act::KillAndResume:
        killAndResume();
        break;
      case Act::Count:
        break;
    }
  }
  /// The daemon is killed and goes on from its checkpoint; operators start anew.
  void killAndResume() {
    if (!machine_->begun()) return;
    const MissionCheckpoint checkpoint = host_->checkpoint();
    const int visits = toy_.visits;
    const bool stood = !machine_->running() || !checkpoint.holds.empty();
    const Stamp clock_start = belief_.clock_start;
    build();
    uuid_lost_ = !host_->restore(checkpoint, now()).has_value() ||
                 machine_->info().mission_uuid != checkpoint.fsm.mission_uuid ||
                 belief_.clock_start != clock_start;
    toy_.visits = visits;
    visits_expected_ = visits;
    if (stood) asleep_ = true;
    press_ = ended_press_ = 0;
  }
  void build() {
    host_.reset();
    machine_ = std::make_unique<ToyMachine>(
        MachineCore::Options{.mission = "toy", .mission_uuid = "u"}, clock_, toy_);
    mission_.emplace(*machine_);
    belief_ = {};
    host_ = std::make_unique<MissionHost>(*mission_, belief_, stop_, clock_);
    authority_.emplace(Authority::Config{});
  }
  void tick() {
    clock_.advanceBy(std::chrono::milliseconds(20));
    for (ReceivedCommand& received : batch_) received.received = received.command.issued = now();
    if (!located_ && host_->phase() == MissionPhase::Running)
      host_->hold(HoldReason::PositionLost, "position lost", now());
    if (host_->observeStop(now())) authority_->invalidate();
    std::vector<OperatorPeer> peers(2);
    peers[0].client_id = "ann";
    peers[1].client_id = "ben";
    for (OperatorPeer& peer : peers) peer.last_heard = now();
    (void)authority_->step(batch_, peers, *this, now());
    host_->goOnWhenAllowed(situation(now()), now());
    host_->tick(now());
  }
  [[nodiscard]] std::string broken(int setpoints_before) {
    host_->check();
    const bool machine_moved = toy_.setpoints != setpoints_before;
    const MissionPhase phase = host_->phase();
    if (machine_moved && (stop_.latched() || host_->mode() == Mode::Teleop ||
                          phase == MissionPhase::Held || phase == MissionPhase::Waiting))
      return "1: the machine writes a setpoint while it may not";
    if (hand_moved_ && machine_moved) return "2: two writers";
    if (asleep_ && deliberate_) asleep_ = false;
    if (asleep_ && hand_moved_ && press_ > ended_press_) asleep_ = false;
    if (asleep_ && machine_moved) return "3: moves without a deliberate act since the STOP";
    if (hand_moved_ && press_ <= ended_press_) return "5: a press that was over moves something";
    if (acknowledged_ && !stop_.latched()) return "4: an acknowledged STOP is gone";
    if (uuid_lost_) return "7: the mission's id was lost";
    if (visits_expected_ >= 0 && toy_.visits < visits_expected_) return "7: counters lost";
    return {};
  }

  ManualClock clock_{Stamp{std::chrono::seconds(100)}};
  Toy toy_;
  StopLatch stop_;
  std::unique_ptr<ToyMachine> machine_;
  std::optional<MachineMission> mission_;
  RobotBelief belief_;
  std::unique_ptr<MissionHost> host_;
  std::optional<Authority> authority_;
  std::vector<ReceivedCommand> batch_;
  std::uint64_t nonce_ = 0, press_ = 0, ended_press_ = 0;
  int visits_expected_ = -1;
  bool ready_ = true, located_ = true;
  bool hand_moved_ = false, deliberate_ = false;
  bool asleep_ = false;        ///< a STOP came, and nothing deliberate since
  bool other_stop_ = false;    ///< comes while the clear of this step is carried out
  bool acknowledged_ = false;  ///< a STOP came in this step
  bool uuid_lost_ = false;
};

struct Sequence {
  bool start_by_itself = false;
  std::vector<Act> acts;
};

std::string run(const Sequence& sequence) {
  Desk desk(sequence.start_by_itself);
  for (const Act act : sequence.acts)
    if (std::string what = desk.perform(act); !what.empty()) return what;
  return {};
}

/// Leaves out one act after the other as long as the sequence still fails.
Sequence shrunk(Sequence sequence) {
  for (std::size_t i = 0; i < sequence.acts.size();) {
    Sequence shorter = sequence;
    shorter.acts.erase(shorter.acts.begin() + static_cast<std::ptrdiff_t>(i));
    if (run(shorter).empty())
      ++i;
    else
      sequence = std::move(shorter), i = 0;
  }
  return sequence;
}

std::string listed(const Sequence& sequence) {
  std::string out = sequence.start_by_itself ? "--start" : "no --start";
  for (const Act act : sequence.acts)
    out += fmt::format(", {}", kNames[static_cast<std::size_t>(act)]);
  return out;
}

TEST(OperatorSequence, BreaksNoInvariant) {
  setLogLevel(6);
  const char* wanted = std::getenv("KILN_SEQUENCES");
  const int sequences = wanted ? std::atoi(wanted) : 5000;
  std::mt19937_64 random(20260101);
  std::uniform_int_distribution<int> act(0, static_cast<int>(Act::Count) - 1), length(5, 60);
  for (int i = 0; i < sequences; ++i) {
    Sequence sequence;
    sequence.start_by_itself = (random() & 1U) != 0;
    if ((random() & 3U) != 0) sequence.acts.push_back(Act::AcquireLease);
    for (int n = length(random); n > 0; --n) sequence.acts.push_back(static_cast<Act>(act(random)));
    if (run(sequence).empty()) continue;
    const Sequence shortest = shrunk(sequence);
    setLogLevel(2);
    FAIL() << "sequence " << i << " breaks invariant " << run(shortest) << "\n  "
           << listed(shortest);
  }
  setLogLevel(2);
}

}  // namespace
}  // namespace kiln
