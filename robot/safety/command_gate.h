#pragma once

#include <string>

#include "common/config/config_archive.h"
#include "common/model/status.h"
#include "robot/safety/operator_peer.h"
#include "robot/safety/replay_filter.h"

namespace kiln {

/// What the robot is doing, as far as it decides what an operator may ask for.
struct GateSituation {
  Mode mode = Mode::None;
  bool stop_latched = false;
  std::uint64_t stop_generation = 0;  ///< StopLatch::generation
  std::string stop_source;
  bool protective_stop = false;
  MissionPhase phase = MissionPhase::Idle;
  std::string position_lost;     ///< why nobody knows where the robot is; empty: it is known
  bool has_pumps = true;
  bool ready = true;             ///< preflight holds
  std::string not_ready_reason;  ///< the first failing check, in words
  bool base_moving = false;      ///< measured
  bool anything_held = false;    ///< a hold-to-run setpoint is alive
  double view_age_s =
      1e9;  ///< newest camera picture or cloud that left for the operator; no view = large
};

struct GateDecision {
  bool accepted = true;
  std::string code;          ///< of a refusal; distinct for each rule
  std::string reason;        ///< one sentence: what, why, what to do
  double speed_scale = 1.0;  ///< jogs: what the link's latency leaves of the speed
};

/// Decides whether a command may pass, in this order: role -> lease and epoch -> replayed or
/// re-ordered -> age -> finite and in range -> mode (architecture.md section 6) -> preconditions.
/// The first rule that objects names the refusal. Releases (explicit zeros) pass regardless of age,
/// mode and preconditions: they only ever stop.
///
/// Codes: viewer no_lease old_lease replayed out_of_order bad_number too_many_clients too_old
/// in_future not_finite out_of_range mission_running moving stopped wrong_mode not_ready
/// already_running not_running not_paused position_lost not_stopped newer_stop still_held
/// no_protective_stop protective_stop stale_view link_slow; press_over comes from the authority.
/// Confined to the mission thread; its only memory is the nonces.
class CommandGate {
 public:
  struct Config {
    double setpoint_age_s = 0.3;
    double discrete_age_s = 1.0;
    double transition_age_s = 2.0;
    double future_tolerance_s = 0.1;  ///< clock estimates err by about half a round trip
    double view_age_s = 0.5;          ///< jogs need a picture or cloud at most this old
    double rtt_amber_s = 0.15;        ///< above: jog at amber_scale
    double rtt_red_s = 0.3;           ///< above: creep_scale
    double rtt_refuse_s = 0.5;        ///< above: no jog
    double amber_scale = 0.5;
    double creep_scale = 0.2;
    double max_jog_speed_mps = 4.0;  ///< beyond this a jog is an error, not a wish to clamp
    double max_jog_rate_radps = 3.2;
    double arena_reach_m = 200.0;  ///< no pose is set further from the origin of map than this
    double max_nudge_m = 0.5;      ///< a fire place that is off by more was configured wrongly
    double max_nudge_deg = 30.0;
    void visit(ConfigArchive& a);
  };
  explicit CommandGate(Config config) : config_(config) {}

  [[nodiscard]] GateDecision decide(const ReceivedCommand& received, const LeaseStatus& lease,
                                    const GateSituation& situation, Stamp now);

 private:
  [[nodiscard]] GateDecision checkSender(const ReceivedCommand& received,
                                         const LeaseStatus& lease) const;
  [[nodiscard]] GateDecision checkFreshness(const ReceivedCommand& received, Stamp now);
  [[nodiscard]] GateDecision checkValues(const CommandBody& body) const;
  [[nodiscard]] GateDecision checkJog(const ReceivedCommand& received,
                                      const GateSituation& situation) const;

  Config config_;
  ReplayFilter replays_;
};

}  // namespace kiln
