#include "gui/panels/fire/work_pose.h"

#include <QPainter>
#include <cmath>

#include "common/core/units.h"
#include "common/wire/fire/codec/fire_codec.h"
#include "common/wire/fire/fire_view.h"
#include "gui/widgets/fitted_text.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr double kReached_m = 0.10, kReached_rad = 5.0 * kDeg;
constexpr int kNarrow_pct = 82;

QString along(double metres, const QString& plus, const QString& minus) {
  return QObject::tr("%1 m %2").arg(std::abs(metres), 0, 'f', 2).arg(metres < 0.0 ? minus : plus);
}
}  // namespace

bool WorkOffset::reached() const {
  return std::hypot(X_base_work.x_m, X_base_work.y_m) <= kReached_m &&
         std::abs(X_base_work.yaw_rad) <= kReached_rad;
}

std::optional<WorkOffset> nearestWorkPose(const FireSite& site, const Pose2& X_map_base) {
  std::optional<WorkOffset> best;
  bool best_visited = false;
  for (const FirePlaceInfo& place : site.places) {
    if (!place.X_map_work) continue;
    const Pose2 X = inverse(X_map_base) * *place.X_map_work;
    const bool nearer = !best || std::hypot(X.x_m, X.y_m) <
                                     std::hypot(best->X_base_work.x_m, best->X_base_work.y_m);
    const bool better =
        !best || (best_visited && !place.visited) || (best_visited == place.visited && nearer);
    if (!better) continue;
    best = WorkOffset{QString::fromStdString(place.name), X};
    best_visited = place.visited;
  }
  return best;
}

QString workText(const WorkOffset& offset) {
  const Pose2& X = offset.X_base_work;
  if (offset.reached()) return QObject::tr("%1: at its work pose ✓").arg(offset.place);
  return QObject::tr("%1: %2, %3, turn %4° %5")
      .arg(offset.place, along(X.x_m, QObject::tr("ahead"), QObject::tr("back")),
           along(X.y_m, QObject::tr("left"), QObject::tr("right")),
           QString::number(std::abs(X.yaw_rad) / kDeg, 'f', 0),
           X.yaw_rad < 0.0 ? QObject::tr("right") : QObject::tr("left"));
}

WorkPoseLine::WorkPoseLine(const Ui& ui, StationModels& models, QWidget* parent)
    : QWidget(parent), ui_(ui), models_(models) {
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  setTip(*this, tr("From the base to where it stands to spray at the nearest place; the outline in "
                   "the scene."));
  connect(&models_.scene, &Model::changed, this, [this] {
    const auto& scene = models_.scene.scene();
    if (!scene || scene->detail.schema != fire::kSiteSchema) return;
    if (auto site = wire::decodeFireSite(scene->detail.data)) site_ = std::move(*site);
    update();
  });
  connect(&models_.status, &Model::changed, this, qOverload<>(&QWidget::update));
  connect(&models_, &StationModels::aged, this, qOverload<>(&QWidget::update));
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

std::optional<WorkOffset> WorkPoseLine::offset() const {
  const RobotStatus* status = models_.status.status();
  if (!status || models_.status.ageLevel() != AgeLevel::Fresh) return std::nullopt;
  return nearestWorkPose(site_, status->X_map_base);
}

QString WorkPoseLine::text() const {
  const auto to = offset();
  return to ? workText(*to) : tr("way to the work pose: not known");
}

void WorkPoseLine::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  const auto to = offset();
  const QFont small = ui_.theme.font(TextRole::Small);
  painter.setPen(!to ? p.faint : to->reached() ? p.ok : p.text);
  paintFitted(painter, rect(), Qt::AlignVCenter | Qt::AlignLeft,
              fitText(text(), {small, condensed(small, kNarrow_pct)}, width(), 1));
}

}  // namespace kiln::gui
