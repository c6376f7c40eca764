#include "gui/panels/fire/place_nudge.h"

#include <QStringList>
#include <algorithm>
#include <cmath>

#include "common/core/units.h"
#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "gui/models/localization_model.h"

namespace kiln::gui {

namespace {
constexpr double kNothing_m = 1e-4;

QString withSign(double value, const QString& text) {
  return (value < 0 ? QStringLiteral("−") : QStringLiteral("+")) + text;
}
}  // namespace

QString offsetText(const PlaceCheck& check) {
  if (!check.X_map_sensed) return QObject::tr("not seen yet");
  const Pose2 by = check.correction();
  return QObject::tr("%1 off (x %2, y %3, yaw %4)")
      .arg(lengthText(check.offset_m), withSign(by.x_m, lengthText(std::abs(by.x_m))),
           withSign(by.y_m, lengthText(std::abs(by.y_m))),
           withSign(by.yaw_rad, angleText(std::abs(by.yaw_rad))));
}

PlaceNudge::PlaceNudge(StationModels& models, QObject* parent) : QObject(parent), models_(models) {
  connect(&models_.scene, &Model::changed, this, &PlaceNudge::follow);
  connect(&models_.commands, &CommandModel::progressed, this, &PlaceNudge::onProgress);
}

QStringList PlaceNudge::places() const {
  QStringList names;
  for (const FirePlaceInfo& row : site_.places) names << QString::fromStdString(row.name);
  return names;
}

const PlaceCheck* PlaceNudge::check(const QString& name) const {
  const auto found =
      std::find_if(site_.place_checks.begin(), site_.place_checks.end(),
                   [&](const PlaceCheck& c) { return QString::fromStdString(c.place) == name; });
  return found == site_.place_checks.end() ? nullptr : &*found;
}

const FirePlaceInfo* PlaceNudge::place(const QString& name) const {
  const auto found =
      std::find_if(site_.places.begin(), site_.places.end(),
                   [&](const FirePlaceInfo& p) { return QString::fromStdString(p.name) == name; });
  return found == site_.places.end() ? nullptr : &*found;
}

QString PlaceNudge::misplaced() const {
  for (const PlaceCheck& row : site_.place_checks) {
    if (row.verdict == PlaceVerdict::Misplaced) return QString::fromStdString(row.place);
  }
  return {};
}

void PlaceNudge::follow() {
  const auto& scene = models_.scene.scene();
  if (scene && scene->detail.schema == fire::kSiteSchema) {
    if (auto site = wire::decodeFireSite(scene->detail.data)) site_ = std::move(*site);
  }
  const QString bad = misplaced();
  if (!bad.isEmpty() && bad != shown_misplaced_) select(bad);
  shown_misplaced_ = bad;
  const QStringList names = places();
  if (!names.contains(selected_)) selected_ = names.isEmpty() ? QString() : names.front();
  emit changed();
}

void PlaceNudge::select(const QString& name) {
  if (name == selected_) return;
  selected_ = name;
  wish_ = {};
  refusal_.clear();
  emit changed();
}

bool PlaceNudge::hasWish() const {
  return std::hypot(wish_.x_m, wish_.y_m) > kNothing_m || std::abs(wish_.yaw_rad) > kNothing_m;
}

/// What the robot would take at a time, as it has described the command.
double PlaceNudge::limited(const char* argument, double value) const {
  const CommandSpec* spec = models_.mission.info().command(fire::kNudgePlace);
  if (!spec) return value;
  for (const ArgumentSpec& row : spec->arguments)
    if (row.name == argument) return std::clamp(value, row.low, row.high);
  return value;
}

void PlaceNudge::add(double dx_m, double dy_m, double dyaw_rad) {
  wish_.x_m = limited("x", wish_.x_m + dx_m);
  wish_.y_m = limited("y", wish_.y_m + dy_m);
  wish_.yaw_rad = limited("yaw", (wish_.yaw_rad + dyaw_rad) / kDeg) * kDeg;
  refusal_.clear();
  emit changed();
}

void PlaceNudge::wishSensed() {
  const PlaceCheck* seen = check(selected_);
  if (!seen || !seen->X_map_sensed) return;
  wish_ = {};
  const Pose2 by = seen->correction();
  add(by.x_m, by.y_m, by.yaw_rad);
}

void PlaceNudge::confirm() {
  if (selected_.isEmpty() || !hasWish()) return;
  send({fire::kNudgePlace,
        selected_.toStdString(),
        {{"x", wish_.x_m}, {"y", wish_.y_m}, {"yaw", wish_.yaw_rad / kDeg}}},
       tr("move %1 by %2, %3").arg(selected_, lengthText(wish_.x_m), lengthText(wish_.y_m)));
}

void PlaceNudge::continueDespite() {
  if (selected_.isEmpty()) return;
  send({fire::kContinueDespite, selected_.toStdString(), {}},
       tr("go on despite the check of %1").arg(selected_));
}

void PlaceNudge::send(MissionCommand command, const QString& label) {
  refusal_.clear();
  nonce_ = models_.commands.send(std::move(command), label);
  if (const TrackedCommand* sent = models_.commands.find(nonce_)) onProgress(*sent);
}

void PlaceNudge::cancel() {
  wish_ = {};
  refusal_.clear();
  emit changed();
}

void PlaceNudge::onProgress(const TrackedCommand& command) {
  if (command.nonce != nonce_ || nonce_ == 0) return;
  if (command.bad()) refusal_ = toText(command.state) + QStringLiteral(": ") + command.reason;
  if (command.state == CommandState::Done && command.name == QLatin1String(fire::kNudgePlace))
    wish_ = {};
  emit changed();
}

}  // namespace kiln::gui
