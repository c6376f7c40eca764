#pragma once

#include <QPointF>

#include "common/model/command.h"
#include "gui/views/teleop/jog_keys.h"

namespace kiln::gui {

enum class ArmJogMode { Move, Turn, Joint };

/// Turns sticks and keys into setpoints. A full stick asks for the full teleop speed; the robot
/// applies the speed scale and the slow-link factor, and clamps again.
class JogMixer {
 public:
  struct Config {  ///< the robot's teleop limits (robot/app Teleop::Config)
    double speed_mps = 1.0;
    double yaw_rate_radps = 0.6;
    double tool_speed_mps = 0.25;
    double tool_rate_radps = 0.6;
    double joint_rate_radps = 0.6;
  };
  JogMixer() : JogMixer(Config{}) {}
  explicit JogMixer(Config config) : config_(config) {}

  QPointF drive;        ///< base stick: x right, y forward
  double turn = 0.0;    ///< base: right positive, as the bar is drawn
  QPointF arm;          ///< arm stick
  double arm_up = 0.0;  ///< arm bar
  ArmJogMode arm_mode = ArmJogMode::Move;
  int joint = 0;  ///< 0..5, ArmJogMode::Joint

  /// Sticks and keys back to rest; the chosen mode and joint stay.
  void rest();
  [[nodiscard]] JogBase base(const JogKeys& keys) const;
  [[nodiscard]] JogArm armSetpoint(const JogKeys& keys) const;
  [[nodiscard]] static bool moves(const JogBase& jog);
  [[nodiscard]] static bool moves(const JogArm& jog);

 private:
  Config config_;
};

}  // namespace kiln::gui
