#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "common/client/command_update.h"
#include "common/core/clock.h"
#include "common/model/command.h"
#include "common/model/fsm.h"
#include "common/model/localization.h"
#include "common/model/scene.h"
#include "common/model/sensor.h"
#include "common/model/status.h"
#include "common/transport/topics.h"

namespace kiln::gui {

class RunHistory;

enum class LinkState : std::uint8_t {
  Connecting,  ///< never heard of the robot yet
  Up,
  Degraded,  ///< nothing heard for 0.5 s, or the robot does not hear us
  Lost,      ///< nothing heard for 1.5 s
  Refused,   ///< the robot answered the hello with a no; `reason` says why
};

/// Both directions of the link, as the station sees it. Sent at 5 Hz or faster.
struct LinkHealth {
  LinkState state = LinkState::Connecting;
  QString endpoint;
  QString reason;                ///< one sentence while not Up, else empty
  double rtt_s = 0.0;            ///< last heartbeat round trip; < 0 unknown
  double loss = 0.0;             ///< of status messages, smoothed over about the last 50
  double heard_age_s = 0.0;      ///< since we last heard the robot
  double robot_hears_age_s = 0;  ///< since the robot last heard us, as it told us
  std::vector<DropCount> drops;  ///< messages this station dropped, per topic
};

/// What became of a STOP press on its own lane.
struct StopLane {
  bool reachable = false;  ///< the stop socket's peer answers
  bool pressed = false;   ///< this station is asking for a stop now (repeated at 20 Hz until acked)
  bool acked = false;     ///< the robot has latched it
  double latch_s = -1.0;  ///< press to ack, measured; < 0 unknown
  std::uint64_t press = 0;  ///< which press of this station the above is about, counted from 1
};

/// The one seam between the station and a robot: live, fake or a recording. Lives on the GUI
/// thread; an implementation keeps its sockets on a thread of its own, and its signals come on the
/// GUI thread, newest value first (latest wins per topic, so a slow GUI never builds up a queue).
class Link : public QObject {
  Q_OBJECT
 public:
  explicit Link(QObject* parent = nullptr) : QObject(parent) {}

  virtual void open() = 0;
  virtual void close() = 0;
  /// The monotonic time base of this station. Ages and holds are measured on it.
  [[nodiscard]] virtual const Clock& clock() const = 0;
  /// Robot time now, from the heartbeats' offset estimate; nullopt until it is known.
  [[nodiscard]] virtual std::optional<Stamp> robotNow() const = 0;
  [[nodiscard]] virtual QString clientId() const = 0;
  [[nodiscard]] virtual QString operatorName() const = 0;

  /// Sends a discrete command once; never re-sent. @return its nonce, by which acks refer to it; 0
  /// if there is no link.
  virtual std::uint64_t send(const CommandBody& body) = 0;
  /// Hold-to-run: streams this setpoint at 25 Hz. One a kind; a new value replaces the old. Repeat
  /// it at 5 Hz or more while it is held: a caller that hangs or forgets is a release after 200 ms.
  /// @param press  from press(), taken when the control was pressed; one that is over moves
  /// nothing.
  virtual void startSetpoint(const CommandBody& body, std::uint64_t press) = 0;
  /// A number for a press that begins now; grows.
  [[nodiscard]] virtual std::uint64_t press() = 0;
  /// Ends the stream of the kind of `example`; the others go on.
  virtual void releaseSetpoint(const CommandBody& example) = 0;
  /// Ends every setpoint stream: an explicit zero, three times.
  virtual void releaseSetpoints() = 0;
  /// STOP (software): own lane, no lease, repeated until latched.
  virtual void stop() = 0;
  /// True for a recording: nothing can be commanded, whatever it shows.
  [[nodiscard]] virtual bool readOnly() const { return false; }

 signals:
  void health(const kiln::gui::LinkHealth& health);
  void stopLane(const kiln::gui::StopLane& lane);
  void hello(const kiln::HelloReply& reply);
  void status(std::shared_ptr<const kiln::RobotStatus> status);
  void fsmInfo(std::shared_ptr<const kiln::FsmInfo> info);
  void fsmStatus(std::shared_ptr<const kiln::FsmStatus> status);
  void cloud(kiln::PointCloudPtr cloud);
  void thermal(kiln::ThermalImagePtr image);
  void missionInfo(std::shared_ptr<const kiln::MissionInfo> info);
  void missionStream(std::shared_ptr<const kiln::MissionDetail> detail);
  void image(kiln::RgbImagePtr image);
  void scene(std::shared_ptr<const kiln::Scene> scene);
  void localization(std::shared_ptr<const kiln::LocalizationStatus> status);
  void trajectory(std::shared_ptr<const kiln::Trajectory> trajectory);
  void mapLayer(std::shared_ptr<const kiln::MapLayer> layer);
  void macros(const std::vector<kiln::MacroInfo>& macros);
  void log(const std::vector<kiln::LogLine>& lines);
  /// Each change of a command of this station, its not being answered in time included.
  void command(const kiln::CommandUpdate& update);
  /// What follows does not go on from what came before (a jump in a recording): forget histories.
  void restarted();
  /// After restarted(): nothing of these had been published at the new time. What is still shown of
  /// them is of another one.
  void absent(const std::vector<kiln::Topic>& topics);
  /// Only of a recording: the whole run, as far as it has been read; again when more is.
  void history(std::shared_ptr<const kiln::gui::RunHistory> history);
};

}  // namespace kiln::gui
