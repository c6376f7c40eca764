#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/client/operator_session.h"
#include "common/core/clock.h"
#include "robot/app/operator_link.h"
#include "robot/evaluation/skewed_clock.h"
#include "robot/safety/authority.h"

namespace kiln::test {

/// A folder for sockets, removed at the end.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  [[nodiscard]] std::string endpoint(const std::string& prefix = "bob") const {
    return "ipc://" + (path_ / prefix).string();
  }

 private:
  std::filesystem::path path_;
};

/// The robot's half without devices: the link, the authority and a mission tick that does as the
/// daemon does.
class LinkedRobot : public Authority::Handler {
 public:
  LinkedRobot(const std::string& endpoint, std::string version = "0.1.0",
              std::string mission = "mission-a");
  /// One mission tick: drains, decides, answers, publishes a status.
  void tick();
  [[nodiscard]] GateSituation situation(Stamp now) const override;
  [[nodiscard]] std::optional<CommandAck> execute(const Authority::Accepted& command,
                                                  Stamp now) override;
  void onReleased(const std::vector<HoldKind>& kinds, Stamp) override {
    released.insert(released.end(), kinds.begin(), kinds.end());
  }
  void onLeaseLost(Stamp) override {}

  SteadyClock clock;
  StopLatch stop;
  std::unique_ptr<OperatorLink> link;
  Authority authority{Authority::Config{}};
  MissionInfo mission;                        ///< actuators: the pumps
  GateSituation base_situation;               ///< but for STOP
  std::vector<Authority::Accepted> accepted;  ///< everything that passed
  std::vector<HoldKind> released;             ///< every dead-man edge
  std::vector<std::string> events;
};

/// An operator whose callbacks are kept for the test to look at.
class LinkedOperator {
 public:
  explicit LinkedOperator(OperatorSession::Config config);
  ~LinkedOperator() { session.reset(); }
  [[nodiscard]] LinkReport link() const { return session->link(); }
  /// The newest fate of a command; Sent before anything was heard.
  [[nodiscard]] CommandUpdate fate(std::uint64_t nonce) const;
  [[nodiscard]] std::vector<CommandUpdate> updates() const;
  [[nodiscard]] std::optional<RobotStatus> status() const;

  /// A station's clock is never the robot's: up to 3 s off, and it drifts (scenario.md section 2).
  SkewedClock clock{std::chrono::milliseconds(-2900), 20.0};
  mutable std::mutex mutex;
  std::map<Topic, int> received;  ///< guarded by mutex
  FsmInfo fsm_info;               ///< guarded by mutex
  PointCloudPtr cloud;            ///< guarded by mutex
  std::unique_ptr<OperatorSession> session;

 private:
  std::map<std::uint64_t, CommandUpdate> fates_;
  std::vector<CommandUpdate> updates_;
  std::optional<RobotStatus> status_;
};

[[nodiscard]] OperatorSession::Config operatorConfig(const std::string& endpoint,
                                                     const std::string& name);
/// Ticks the robot until `condition` holds; false after `limit_s`.
[[nodiscard]] bool tickUntil(LinkedRobot& robot, const std::function<bool()>& condition,
                             double limit_s = 20.0);
/// Connects, waits for the clock estimate and takes the lease.
[[nodiscard]] bool takeControl(LinkedRobot& robot, LinkedOperator& op);
[[nodiscard]] bool connected(LinkedRobot& robot, LinkedOperator& op);

}  // namespace kiln::test
