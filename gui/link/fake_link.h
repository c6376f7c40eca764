#pragma once

#include <QTimer>
#include <map>

#include "gui/link/fake_robot.h"
#include "gui/link/link.h"

namespace kiln::gui {

/// A link to a robot that is acted out inside the station (`--fake SEED`). Its clock is its own:
/// with `speed` 4 a mission of two minutes passes in thirty seconds, and tests step it without
/// waiting.
class FakeLink : public Link {
  Q_OBJECT
 public:
  struct Options {
    std::uint64_t seed = 1;
    double speed = 1.0;
    bool autostart = false;    ///< begin the mission 2 s after open()
    bool with_sensors = true;  ///< clouds and pictures; tests of logic do without
    bool run_by_timer = true;  ///< false: only advance() moves time
  };
  explicit FakeLink(Options options, QObject* parent = nullptr);

  void open() override;
  void close() override;
  [[nodiscard]] const Clock& clock() const override { return clock_; }
  [[nodiscard]] std::optional<Stamp> robotNow() const override { return clock_.now(); }
  [[nodiscard]] QString clientId() const override { return QStringLiteral("fake-station"); }
  [[nodiscard]] QString operatorName() const override { return QStringLiteral("you"); }
  std::uint64_t send(const CommandBody& body) override;
  void startSetpoint(const CommandBody& body, std::uint64_t press) override;
  [[nodiscard]] std::uint64_t press() override;
  void releaseSetpoint(const CommandBody& example) override;
  void releaseSetpoints() override;
  void stop() override;

  /// Lets `seconds` pass in steps of 50 ms and emits what falls due.
  void advance(double seconds);
  /// The robot falls silent (or comes back) while the station's time goes on.
  void setSilent(bool silent) { silent_ = silent; }
  /// Acks are withheld, as by an up-link that is gone.
  void setDeaf(bool deaf) { deaf_ = deaf; }
  [[nodiscard]] FakeRobot& robot() { return robot_; }
  [[nodiscard]] const std::vector<CommandBody>& sent() const {
    return sent_;
  }  ///< every discrete command
  [[nodiscard]] bool holding() const { return !held_.empty(); }

 private:
  void step(double dt_s);
  void publishState();
  void publishSensors();
  void publishHealth();
  void latchStop();
  Options options_;
  ManualClock clock_;
  FakeRobot robot_;
  QTimer timer_;
  std::uint64_t tick_ = 0;
  std::uint64_t next_nonce_ = 1;
  std::map<std::size_t, CommandBody> held_;
  std::uint64_t last_press_ = 0;
  std::vector<CommandBody> sent_;
  bool silent_ = false, deaf_ = false;
  Stamp heard_;
  StopLane lane_;
};

}  // namespace kiln::gui
