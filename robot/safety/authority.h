#pragma once

#include <map>
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
  struct Step {
    /// To execute, in order. Lease commands are done here already. Discrete ones must be answered
    /// by the executor (Accepted, Done, Failed ...); setpoints are not answered when fine.
    std::vector<Accepted> accepted;
    std::vector<CommandAck> acks;     ///< to send now: refusals, lease answers
    std::vector<HoldKind> released;   ///< holds that ended since the last step: stop those at once
    std::vector<std::string> events;  ///< for the log: who got or lost control and why
    bool lease_lost = false;          ///< the holder went away, died or was stopped in this step
  };

  explicit Authority(Config config);

  /// @param stops  a STOP revokes the lease and ends every hold before any command of this step is
  /// looked at.
  [[nodiscard]] Step step(std::vector<ReceivedCommand> received,
                          const std::vector<OperatorPeer>& peers,
                          const std::vector<StopEvent>& stops, GateSituation situation, Stamp now);

  [[nodiscard]] bool held(HoldKind kind, Stamp now) const { return dead_man_.held(kind, now); }
  [[nodiscard]] LeaseStatus lease(Stamp now) const { return lease_.status(now); }
  /// Moves on with each stop and change of the lease: multi-step work that began under another
  /// value must end.
  [[nodiscard]] const SafetyEpoch& epoch() const { return epoch_; }
  /// The mission's own reasons (loss of localisation, shutdown): ends every hold, keeps the lease.
  void invalidate();

 private:
  void handle(const ReceivedCommand& received, const GateSituation& situation, Stamp now,
              Step& step);
  void answerLease(const ReceivedCommand& received, Stamp now, Step& step);
  void applyEvents(Stamp now, Step& step);
  [[nodiscard]] bool answerRefusal(const Command& command, const std::string& code, Stamp now);

  Config config_;
  Lease lease_;
  CommandGate gate_;
  DeadMan dead_man_;
  SafetyEpoch epoch_;
  std::map<std::string, Stamp> last_refusal_;  ///< of setpoints, by client, kind and code; bounded
};

}  // namespace kiln
