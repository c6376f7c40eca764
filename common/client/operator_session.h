#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/client/command_update.h"
#include "common/client/stop_caller.h"
#include "common/client/topic_values.h"
#include "common/core/clock.h"
#include "common/core/error.h"
#include "common/model/link.h"

namespace kiln {

/// How the link stands, both ways. Degraded at 0.5 s without a message either way, lost at 1.5 s.
enum class LinkState : std::uint8_t { Connecting, Connected, Degraded, Lost, Refused };
[[nodiscard]] std::string_view toString(LinkState state);

/// Delivered at 5 Hz and by link().
struct LinkReport {
  LinkState state = LinkState::Connecting;
  std::string reason;      ///< why not Connected: one sentence
  double rx_age_s = -1.0;  ///< since the robot was heard last; < 0 = never
  double robot_rx_age_s =
      -1.0;            ///< since the robot heard us last, as it reports: the up-link; < 0 = unknown
  double rtt_s = 0.0;  ///< newest exchange
  double rtt_p95_s = 0.0;            ///< over the last 64 exchanges
  bool clock_known = false;          ///< the offset is estimated: commands may be sent
  double clock_offset_s = 0.0;       ///< robot time minus station time
  double clock_uncertainty_s = 0.0;  ///< the true offset lies within +- this
  double clock_drift_ppm = 0.0;
  std::uint64_t bytes_received = 0;  ///< all topics, since start
  std::vector<DropCount>
      drops;  ///< lost between robot and here, by topic, plus what the robot dropped before
};

/// A client's lease as the session knows it.
struct LeaseView {
  bool mine = false;
  std::uint64_t epoch = 0;  ///< of the present or, if not mine, the last lease
};

/// An operator's connection to one robot, without Qt: hello, lease, heartbeats, commands with acks,
/// hold-to-run streams, STOP lane, subscriptions.
///
/// Threads: `link` (sole owner of the command and subscription sockets) and `stop` (own ZeroMQ
/// context). All methods are thread-safe and never block on the network. Callbacks run on the link
/// thread (on_stop: on the stop thread), one at a time each; they must be quick and must not
/// destroy the session.
class OperatorSession {
 public:
  struct Config {
    std::string endpoint = "tcp://127.0.0.1:7300";  ///< as OperatorLink::Config::endpoint
    std::string operator_name = "operator";
    std::string program_version;
    ClientRole role = ClientRole::Operator;
    std::string expected_mission_uuid;  ///< empty: any
    std::vector<Topic> topics;          ///< empty: all
    double setpoint_rate_hz = 25.0;
    double hold_ttl_s =
        0.2;  ///< hold() must be repeated within this, or the session releases by itself
    double ack_timeout_s = 1.0;
    double degraded_after_s = 0.5;
    double lost_after_s = 1.5;
    // Link-fault injection, for training and tests.
    double up_loss = 0.0, down_loss = 0.0;  ///< share of messages thrown away, 0..1
    double up_delay_s = 0.0;
    std::uint64_t fault_seed = 1;
  };
  struct Callbacks {
    std::function<void(const LinkReport&)> on_link;  ///< 5 Hz and on each change of state
    std::function<void(const HelloReply&)> on_hello;
    std::function<void(const CommandUpdate&)> on_command;
    std::function<void(const StopReport&)> on_stop;
    std::function<void(const LeaseView&)> on_lease;  ///< when it changes
    TopicSubscribers topics;
    /// A message that could not be decoded: counted, named, dropped.
    std::function<void(const Error&)> on_bad_message;
  };

  /// Starts both threads; connecting goes on in the background. `clock` must outlive the session.
  /// Error: Refused for an address that is neither ipc nor loopback.
  [[nodiscard]] static Result<std::unique_ptr<OperatorSession>> open(Config config,
                                                                     Callbacks callbacks,
                                                                     const Clock& clock);
  ~OperatorSession();  ///< releases all held setpoints first
  OperatorSession(const OperatorSession&) = delete;
  OperatorSession& operator=(const OperatorSession&) = delete;

  /// Sends a discrete command once; its fate arrives at on_command under the returned nonce.
  /// Without a link or clock estimate it is refused on the spot (code "no_link"): nothing is queued
  /// for later.
  std::uint64_t send(CommandBody body);

  /// Hold-to-run: streams this setpoint (JogBase, JogArm, HoldActuator, HoldMacro) at 25 Hz. One a
  /// kind; a new value replaces the old. The caller repeats it while the key is held (any rate
  /// above 5 Hz); a caller that hangs or forgets is a release after hold_ttl_s.
  /// @param press  from press(), taken when the control was pressed. A press that has ended, here
  /// or on the robot, moves nothing any more: let go and press again.
  void hold(CommandBody setpoint, std::uint64_t press);
  [[nodiscard]] std::uint64_t press();
  /// Release edge: zero three times, then silence. No effect when nothing of the kind of `example`
  /// is held.
  void release(const CommandBody& example);
  void releaseAll();

  /// STOP (software): its own lane, no lease, repeated at 20 Hz until acknowledged.
  void stop();

  [[nodiscard]] const std::string& clientId() const;
  [[nodiscard]] LinkReport link() const;
  [[nodiscard]] LeaseView lease() const;
  [[nodiscard]] StopReport stopReport() const;
  /// Station time of a robot stamp; nullopt while the clock offset is unknown.
  [[nodiscard]] std::optional<Stamp> toStationTime(Stamp robot) const;
  [[nodiscard]] std::optional<Stamp> toRobotTime(Stamp station) const;

 private:
  struct Impl;
  explicit OperatorSession(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kiln
