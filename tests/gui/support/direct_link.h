#pragma once

#include <QTimer>
#include <optional>

#include "common/client/command_tracker.h"
#include "common/client/hold_stream.h"
#include "gui/link/link.h"
#include "tests/support/test_robot.h"

namespace kiln::gui {

class SampleWorld;

/// The station's link to a robot in the same process: no sockets, the robot's own answers. Time
/// moves when told (advance(), or with the wall clock after runByTimer()), robot time equals
/// station time.
class DirectLink : public Link {
  Q_OBJECT
 public:
  /// Both ends' words for this station.
  static constexpr const char* kClient = "this-station";
  static constexpr const char* kOperator = "Ann";

  /// @param sensors  clouds and pictures too.
  explicit DirectLink(bool sensors = false, QObject* parent = nullptr);
  ~DirectLink() override;

  void open() override;
  void close() override { timer_.stop(); }
  [[nodiscard]] const Clock& clock() const override { return robot_.clock(); }
  [[nodiscard]] std::optional<Stamp> robotNow() const override { return robot_.now(); }
  [[nodiscard]] QString clientId() const override { return QString::fromLatin1(kClient); }
  [[nodiscard]] QString operatorName() const override { return QString::fromLatin1(kOperator); }
  std::uint64_t send(const CommandBody& body) override;
  void startSetpoint(const CommandBody& body, std::uint64_t press) override;
  [[nodiscard]] std::uint64_t press() override { return holds_.press(); }
  void releaseSetpoint(const CommandBody& example) override { holds_.release(example); }
  void releaseSetpoints() override { holds_.releaseAll(); }
  void stop() override;

  /// Lets `seconds` pass and emits what falls due.
  void advance(double seconds);
  /// From now on time passes by itself, for tests with real input events.
  void runByTimer();
  /// Nothing passes in either direction, while time goes on.
  void setSilent(bool silent);
  /// Nothing of this station arrives; it hears the robot.
  void setDeaf(bool deaf);
  /// Tells the newest state once more, as it is now.
  void publishState();

  [[nodiscard]] TestRobot& robot() { return robot_; }
  /// Every discrete command.
  [[nodiscard]] const std::vector<CommandBody>& sent() const { return sent_; }

 private:
  [[nodiscard]] Monotonic::time_point monotonic() const;
  void step();
  void deliverAcks();
  void publishSensors();
  void publishHealth();
  void latchStop();

  TestRobot robot_;
  bool sensors_;
  std::unique_ptr<SampleWorld> world_;  ///< what its cameras and its LiDAR would see
  HoldStream holds_{25.0, 0.2};
  CommandTracker tracker_{1.0};
  QTimer timer_;
  SteadyClock wall_;
  Stamp opened_, opened_wall_;  ///< when runByTimer() was called
  std::uint64_t tick_ = 0, lost_nonce_ = std::uint64_t{1} << 62U;
  std::vector<CommandBody> sent_;
  bool silent_ = false, deaf_ = false;
  Stamp heard_, robot_heard_;
  StopLane lane_;
  ThermalImagePtr shown_thermal_;
  std::shared_ptr<const MissionDetail> shown_stream_;
};

}  // namespace kiln::gui
