#include "gui/models/station_models.h"

#include "gui/models/alone.h"

namespace kiln::gui {
namespace {
constexpr int kInfo = 2, kWarn = 3, kError = 4;  // of the log
}

StationModels::StationModels(Link& link_in, QObject* parent)
    : QObject(parent),
      link(link_in),
      commands(link),
      status(link),
      link_state(link),
      stop(link, commands),
      lease(link, commands),
      fsm(link),
      mission(link),
      cloud(link),
      thermal(link),
      camera(link, "operator_camera"),
      head_camera(link, "rgb"),
      scene(link),
      localization(link),
      map(link),
      macros(link),
      alarms(link, commands),
      log(link),
      history(link, alarms, commands) {
  connect(&flush_timer_, &QTimer::timeout, this, &StationModels::flush);
  // First of all listeners: what the station itself watches is up to date when the views look.
  connect(this, &StationModels::aged, this, [this] {
    watchLink();
    watchViews();
    history.watchAlarms();
  });
  connect(&age_timer_, &QTimer::timeout, this, &StationModels::aged);
  connect(&commands, &CommandModel::progressed, this, [this](const TrackedCommand& command) {
    if (command.bad())
      log.addOwn(kWarn, command.label + ": " + toText(command.state) + ", " + command.reason);
    if (command.state == CommandState::Sent) log.addOwn(kInfo, command.label + ": sent");
  });
  connect(&alarms, &AlarmModel::ownChanged, this, [this](const Alarm& alarm) {
    const QString text = QString::fromStdString(alarm.text);
    if (!alarm.active) return log.addOwn(kInfo, tr("alarm over: %1").arg(text));
    log.addOwn(alarm.level == AlarmLevel::Advisory ? kWarn : kError,
               tr("alarm: %1; %2").arg(text, QString::fromStdString(alarm.action)));
  });
  flush_timer_.start(kFlushPeriod_ms);
  age_timer_.start(kAgePeriod_ms);
}

Stamp StationModels::robotNow() const { return link.robotNow().value_or(status.stamp()); }

bool StationModels::mayCommand(QString* why) const {
  const auto refuse = [why](const QString& text) {
    if (why) *why = text;
    return false;
  };
  if (link.readOnly()) return refuse(tr("a recording cannot be commanded"));
  if (status.word() == StatusWord::NoLink || link_state.health().state == LinkState::Lost)
    return refuse(tr("no link to the robot"));
  if (stop.latched()) return refuse(tr("stopped: clear the stop first"));
  if (lease.holder() == LeaseHolder::Other)
    return refuse(tr("%1 has the lease").arg(lease.holderName()));
  if (!lease.mine()) return refuse(tr("needs the lease: request it in the top bar"));
  return true;
}

bool StationModels::mayJog(QString* why) const {
  if (!mayCommand(why)) return false;
  if (status.status()->mode == Mode::Teleop) return true;
  if (why) *why = tr("needs Teleop mode");
  return false;
}

void StationModels::flush() {
  for (Model* model :
       {static_cast<Model*>(&commands), static_cast<Model*>(&status),
        static_cast<Model*>(&link_state), static_cast<Model*>(&stop), static_cast<Model*>(&lease),
        static_cast<Model*>(&fsm), static_cast<Model*>(&mission), static_cast<Model*>(&cloud),
        static_cast<Model*>(&thermal), static_cast<Model*>(&camera),
        static_cast<Model*>(&head_camera), static_cast<Model*>(&scene),
        static_cast<Model*>(&localization), static_cast<Model*>(&map), static_cast<Model*>(&macros),
        static_cast<Model*>(&alarms), static_cast<Model*>(&log), static_cast<Model*>(&history)}) {
    model->flush();
  }
}

void StationModels::watchLink() {
  if (link.readOnly()) return;  // a recording has neither a link nor cameras that could fail now
  const LinkHealth& health = link_state.health();
  const bool heard_before = status.hasData();
  alarms.setOwn(
      QStringLiteral("station.link_lost"), AlarmLevel::Warning,
      heard_before && health.state == LinkState::Lost,
      tr("No link to the robot: it does not answer"),
      heard_before
          ? tr("as last heard %1; check radio and robot").arg(whatItDoesAlone(*status.status()))
          : QString());
  alarms.setOwn(
      QStringLiteral("station.not_heard"), AlarmLevel::Caution,
      heard_before && health.state == LinkState::Degraded && health.robot_hears_age_s > 1.5,
      tr("The robot does not hear this station"),
      tr("commands do not arrive; STOP has its own lane and may not arrive either"));
  alarms.setOwn(QStringLiteral("station.refused"), AlarmLevel::Warning,
                health.state == LinkState::Refused,
                tr("The robot refused this station: %1").arg(health.reason),
                tr("start matching versions on both ends"));
}

void StationModels::watchViews() {
  // Without a link nobody knows whether a camera is back: what stands goes on standing.
  if (link.readOnly() || link_state.health().state != LinkState::Up) return;
  alarms.setOwn(QStringLiteral("station.camera_stale"), AlarmLevel::Caution,
                camera.hasData() && camera.ageLevel() == AgeLevel::Red,
                tr("Operator camera frozen %1 s").arg(camera.ageS(), 0, 'f', 1),
                tr("check its cable or use another view; jog from it is locked"));
  alarms.setOwn(QStringLiteral("station.thermal_stale"), AlarmLevel::Caution,
                thermal.hasData() && thermal.ageLevel() == AgeLevel::Red,
                tr("Thermal camera frozen %1 s").arg(thermal.ageS(), 0, 'f', 1),
                tr("check its cable"));
}

}  // namespace kiln::gui
