#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "common/client/operator_session.h"
#include "common/core/clock.h"

namespace kiln {

/// A stand-in for a person at the station: sees only what the link shows and acts only through
/// commands. Used where an evaluation needs hand commands. Blocking; confined to one thread.
class ScriptedOperator {
 public:
  /// What the operator sees.
  struct View {
    std::optional<RobotStatus> status;
    std::optional<MissionDetail> stream;  ///< newest of the mission stream
    std::optional<Scene> scene;
    std::optional<CommandUpdate> last_command;
    /// Newest word on each of the last commands, by nonce: an answer may be followed at once by
    /// another's, as those to a held setpoint are.
    std::map<std::uint64_t, CommandUpdate> answers;
    LeaseView lease;
    StopReport stop;
    LinkReport link;
  };
  /// @param clock  the station's; nullptr: a steady one of its own. In lockstep, where robot time
  ///               outruns the wall's, the robot's own: the two ends then have no offset to learn.
  [[nodiscard]] static Result<std::unique_ptr<ScriptedOperator>> connect(
      const std::string& endpoint, const std::string& name, Duration limit,
      const Clock* clock = nullptr);

  /// Waits until the view satisfies `condition`. Error: Timeout, naming `what`.
  [[nodiscard]] Result<void> waitFor(const std::string& what, Duration limit,
                                     const std::function<bool(const View&)>& condition);
  /// Sends a discrete command and waits for its answer. Error: Refused with the robot's reason.
  [[nodiscard]] Result<void> command(CommandBody body);
  /// Takes the lease and enters Teleop.
  [[nodiscard]] Result<void> takeOver();
  /// Repeats a held setpoint, computed from the view, until `setpoint` returns nullopt (released)
  /// or the limit passes.
  [[nodiscard]] Result<void> holdWhile(
      const std::string& what, Duration limit,
      const std::function<std::optional<CommandBody>(const View&)>& setpoint);
  /// Drives by hand to a pose in map: stick towards it until within `tolerance_m`.
  [[nodiscard]] Result<void> driveTo(const Pose2& goal, double tolerance_m);
  [[nodiscard]] View view() const;
  [[nodiscard]] OperatorSession& session() { return *session_; }

 private:
  ScriptedOperator() = default;
  [[nodiscard]] OperatorSession::Callbacks callbacks();
  template <class Change>
  void update(Change change);

  SteadyClock clock_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  View view_;
  std::unique_ptr<OperatorSession> session_;  // last: its threads use everything above
};

}  // namespace kiln
