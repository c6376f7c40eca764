#include "gui/views/scene3d/pose_chip.h"

#include <QFontMetrics>
#include <QPainter>
#include <cmath>

#include "common/core/units.h"
#include "gui/widgets/text.h"

namespace kiln::gui {

namespace {
constexpr int kPad_px = 8;
constexpr double kTouching_m = 0.005;  // shows as 0.00 m
constexpr double kNear_m = 0.3;        // amber: the base needs so much to stop from walking pace

QString signedText(double value, int decimals) {
  const QString digits = QString::number(std::abs(value), 'f', decimals);
  const bool negative = value < 0.0 && digits.toDouble() != 0.0;
  return (negative ? QStringLiteral("−") : QStringLiteral("+")) + digits;
}
}  // namespace

PoseChip::PoseChip(const Ui& ui, const StationModels& models, QWidget* parent)
    : QWidget(parent), ui_(ui), models_(models) {
  setTip(*this, tr("The base in the map, its measured speed, and the nearest point of the newest "
                   "cloud from the edge of the robot's footprint. What has come nearer than the "
                   "LiDAR can tell from the robot is remembered for 20 s."));
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
  resize(sizeHint());
}

QSize PoseChip::sizeHint() const {
  const QFontMetrics metrics(ui_.theme.font(TextRole::Small));
  const int widest =
      std::max(metrics.horizontalAdvance(tr("x −88.88 m  y −88.88 m  yaw −188°")),
               metrics.horizontalAdvance(tr("8.88 m/s · nearest 88.88 m ahead right")));
  return {widest + 2 * kPad_px, 2 * metrics.height() + kPad_px};
}

void PoseChip::show(const std::optional<Clearance>& clearance) {
  clearance_ = clearance;
  update();
}

QString PoseChip::pose() const {
  const RobotStatus* status = models_.status.status();
  if (!status || models_.status.ageLevel() != AgeLevel::Fresh) return tr("x – m  y – m  yaw –°");
  const Pose2& X = status->X_map_base;
  return tr("x %1 m  y %2 m  yaw %3°")
      .arg(signedText(X.x_m, 2), signedText(X.y_m, 2), signedText(X.yaw_rad / kDeg, 0));
}

QString PoseChip::drive() const {
  const RobotStatus* status = models_.status.status();
  const bool heard = status && models_.status.ageLevel() == AgeLevel::Fresh;
  const double speed_mps = heard ? std::hypot(status->twist.vx_mps, status->twist.vy_mps) : NAN;
  const QString speed =
      std::isfinite(speed_mps) ? QString::number(speed_mps, 'f', 2) : QStringLiteral("–");
  const bool seen = heard && clearance_ && models_.cloud.ageLevel() == AgeLevel::Fresh;
  if (!seen) return tr("%1 m/s · nearest –").arg(speed);
  const QString side = tr(sideWord(clearance_->bearing_rad));
  if (clearance_->distance_m < kTouching_m) return tr("%1 m/s · TOUCHING %2").arg(speed, side);
  return tr("%1 m/s · nearest %2 m %3")
      .arg(speed, QString::number(clearance_->distance_m, 'f', 2), side);
}

bool PoseChip::near() const {
  return clearance_ && clearance_->distance_m < kNear_m &&
         models_.cloud.ageLevel() == AgeLevel::Fresh;
}

void PoseChip::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QColor ground = near() ? p.caution_fill : p.panel;
  ground.setAlpha(230);
  painter.setPen(QPen(near() ? p.caution : p.border, 1.2));
  painter.setBrush(ground);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.6, 0.6, -0.6, -0.6), 4, 4);
  painter.setFont(ui_.theme.font(TextRole::Small));
  painter.setPen(p.text);
  const QRect text = rect().adjusted(kPad_px, kPad_px / 2, -kPad_px, -kPad_px / 2);
  painter.drawText(text, Qt::AlignTop | Qt::AlignLeft, pose());
  painter.drawText(text, Qt::AlignBottom | Qt::AlignLeft, drive());
}

}  // namespace kiln::gui
