#include "gui/views/teleop/hold_to_run.h"

namespace kiln::gui {
namespace {

QString ageOrNone(double age_s) {
  return age_s < 0 ? HoldToRun::tr("none") : HoldToRun::tr("%1 s").arg(age_s, 0, 'f', 1);
}

}  // namespace

HoldToRun::HoldToRun(StationModels& models, Config config, QObject* parent)
    : QObject(parent), models_(models), config_(config) {
  connect(&renew_, &QTimer::timeout, this, &HoldToRun::renew);
  connect(&models_.link, &Link::command, this, [this](const CommandUpdate& update) {
    if (update.code == "press_over" && holding())
      releaseAll(tr("the robot has ended this hold: let go and press again"));
  });
}

HoldToRun::~HoldToRun() {
  if (holding()) models_.link.releaseSetpoints();
}

QString HoldToRun::viewLock() const {
  const double cloud_s = models_.cloud.ageS(), video_s = models_.camera.ageS();
  const bool cloud_fresh = cloud_s >= 0 && cloud_s <= config_.fresh_view_s;
  const bool video_fresh = video_s >= 0 && video_s <= config_.fresh_view_s;
  if (cloud_fresh || video_fresh) return {};
  return tr("no fresh view: cloud %1, video %2 old").arg(ageOrNone(cloud_s), ageOrNone(video_s));
}

QString HoldToRun::lock(HoldKind kind) const {
  QString why;
  if (kind == HoldKind::Macro) {
    if (!models_.mayCommand(&why)) return why;
    const Mode mode = models_.status.status()->mode;
    return mode == Mode::Teleop ? QString() : tr("needs Teleop mode");
  }
  if (!models_.mayJog(&why)) return why;
  if (kind == HoldKind::Actuator) return {};
  const double rtt_s = models_.link_state.health().rtt_s;
  if (rtt_s > config_.rtt_refused_s)
    return tr("link too slow to jog: round trip %1 ms, limit %2 ms")
        .arg(1e3 * rtt_s, 0, 'f', 0)
        .arg(1e3 * config_.rtt_refused_s, 0, 'f', 0);
  return viewLock();
}

QString HoldToRun::slowdown() const {
  const double rtt_s = models_.link_state.health().rtt_s;
  if (rtt_s > config_.rtt_creep_s)
    return tr("round trip %1 ms: creeps").arg(1e3 * rtt_s, 0, 'f', 0);
  if (rtt_s > config_.rtt_slow_s)
    return tr("round trip %1 ms: half speed").arg(1e3 * rtt_s, 0, 'f', 0);
  return {};
}

bool HoldToRun::hold(HoldKind kind, const CommandBody& body) {
  const QString why = lock(kind);
  if (!why.isEmpty()) {
    if (holding(kind)) releaseAll(why);
    return false;
  }
  const bool first = !holding(kind);
  Hold& held = held_[kind];
  held.body = body;
  if (first) held.press = models_.link.press();
  models_.link.startSetpoint(body, held.press);
  if (!renew_.isActive()) {
    renewed_ = models_.link.clock().now();
    renew_.start(config_.renew_ms);
  }
  // A macro starts from its first step once; the renewals only keep it running.
  if (auto* macro = std::get_if<HoldMacro>(&held.body)) macro->restart = false;
  if (first) emit changed();
  return true;
}

void HoldToRun::release(HoldKind kind) {
  const auto found = held_.find(kind);
  if (found == held_.end()) return;
  const CommandBody body = found->second.body;
  held_.erase(found);
  if (held_.empty()) {
    renew_.stop();
    models_.link.releaseSetpoints();
  } else {
    models_.link.releaseSetpoint(body);
  }
  emit changed();
}

void HoldToRun::releaseAll(const QString& why) {
  const bool any = holding();
  held_.clear();
  renew_.stop();
  models_.link.releaseSetpoints();
  emit tripped(any ? why : QString());
  if (any) emit changed();
}

void HoldToRun::renew() {
  const Stamp now = models_.link.clock().now();
  // The stream has ended by itself meanwhile, and with it the press.
  if (toSeconds(now - renewed_) > config_.stall_s)
    return releaseAll(tr("the window was busy: let go and press again"));
  renewed_ = now;
  for (const auto& [kind, held] : held_) {
    const QString why = lock(kind);
    if (!why.isEmpty()) return releaseAll(why);
  }
  for (const auto& [kind, held] : held_) models_.link.startSetpoint(held.body, held.press);
}

}  // namespace kiln::gui
