#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "robot/safety/command_gate.h"
#include "robot/safety/dead_man.h"
#include "robot/safety/lease.h"
#include "robot/safety/safety_epoch.h"

namespace kiln {

/// Lease, gate, dead-man and safety epoch in one: turns what the link received into what may be
/// executed and what must be answered. Called once a mission tick; confined to the mission thread.
class Authority {
 public:
  struct Config {
    Lease::Config lease;
    CommandGate::Config gate;
    DeadMan::Config dead_man;
    double refusal_period_s = 0.2;  ///< a refused setpoint stream is answered at most this often
    void visit(ConfigArchive& a);
  };
  struct Accepted {
    Command command;
    Stamp received;
    double speed_scale = 1.0;  ///< jogs: what the link's latency leaves
  };
  /// Who executes: asked for the situation anew before each command, so that every one is judged
  /// against what the one before it has changed.
  class Handler {
   public:
    virtual ~Handler() = default;
    [[nodiscard]] virtual GateSituation situation(Stamp now) const = 0;
    /// @return the answer of a discrete command; setpoints are not answered when fine.
    [[nodiscard]] virtual std::optional<CommandAck> execute(const Accepted& accepted,
                                                            Stamp now) = 0;
    /// Holds that have ended: stop those at once.
    virtual void onReleased(const std::vector<HoldKind>& kinds, Stamp now) = 0;
    /// The holder went away, died or was stopped.
    virtual void onLeaseLost(Stamp now) = 0;
  };
  struct Step {
    std::vector<CommandAck> acks;     ///< to send now
    std::vector<std::string> events;  ///< for the log: who got or lost control and why
  };

  explicit Authority(Config config);

  /// A new STOP, from wherever it came (GateSituation::stop_generation), revokes the lease and ends
  /// every hold before any command of this step is looked at. Lease commands are done here.
  [[nodiscard]] Step step(const std::vector<ReceivedCommand>& received,
                          const std::vector<OperatorPeer>& peers, Handler& handler, Stamp now);

  [[nodiscard]] bool held(HoldKind kind, Stamp now) const { return dead_man_.held(kind, now); }
  [[nodiscard]] LeaseStatus lease(Stamp now) const { return lease_.status(now); }
  /// Moves on with each stop and change of the lease: multi-step work that began under another
  /// value must end.
  [[nodiscard]] const SafetyEpoch& epoch() const { return epoch_; }
  /// Ends every hold and all multi-step work, keeps the lease: the mode changes, a shutdown.
  void invalidate();
  /// The work behind a hold has ended or could not begin: its press is over.
  void endHold(HoldKind kind) { dead_man_.end(kind); }

 private:
  void handle(const ReceivedCommand& received, Handler& handler, Stamp now, Step& step);
  [[nodiscard]] GateDecision judge(const ReceivedCommand& received, const LeaseStatus& lease,
                                   GateSituation situation, Stamp now);
  void answerLease(const ReceivedCommand& received, Handler& handler, Stamp now, Step& step);
  void applyEvents(Handler& handler, Stamp now, Step& step);
  [[nodiscard]] bool answerRefusal(const Command& command, const std::string& code, Stamp now);

  Config config_;
  Lease lease_;
  CommandGate gate_;
  DeadMan dead_man_;
  SafetyEpoch epoch_;
  std::uint64_t stop_seen_ = 0;                ///< generation
  bool stop_said_ = false;                     ///< of the latch as it is
  std::map<std::string, Stamp> last_refusal_;  ///< of setpoints, by client, kind and code; bounded
};

}  // namespace kiln
