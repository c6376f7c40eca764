#include "gui/views/scene3d/scene_labels.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "gui/views/scene3d/orbit_camera.h"
#include "gui/views/scene3d/scene_actor.h"

namespace kiln::gui {
namespace {

constexpr double kZeroCelsius_k = 273.15;
constexpr int kPadding = 7, kOffset = 26;
constexpr double kRing_px = 9.0;

QColor qt(Rgb c, int alpha = 255) { return {c.r, c.g, c.b, alpha}; }

double twoSigma_m(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return std::nan("");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return 2.0 * std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

QFont scaled(const QFont& base, double factor, bool bold) {
  QFont font = base;
  font.setPointSizeF(std::max(8.0, base.pointSizeF() * factor));
  font.setBold(bold);
  return font;
}

/// A ring round the estimate: it would otherwise hide in the box behind whose opening it burns.
void paintTarget(QPainter& painter, const QPointF& at, const SceneColors& colors,
                 Freshness freshness) {
  const QColor color = qt(agedColor(colors.fire, freshness, colors));
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(color, 2.0));
  painter.drawEllipse(at, kRing_px, kRing_px);
  for (const QPointF& d : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
    painter.drawLine(at + kRing_px * d, at + (kRing_px + 5.0) * d);
}

/// A small card with a leader line to its anchor.
void paintCard(QPainter& painter, const QPointF& anchor, const FireLabel& label,
               const SceneColors& colors, const QSize& size) {
  const QFont title = scaled(painter.font(), 1.0, true),
              detail = scaled(painter.font(), 0.92, false);
  const QFontMetricsF title_metrics(title), detail_metrics(detail);
  const double width = std::max(title_metrics.horizontalAdvance(label.title),
                                detail_metrics.horizontalAdvance(label.detail)) +
                       2 * kPadding;
  const double height = title_metrics.height() + detail_metrics.height() + 1.4 * kPadding;
  QPointF corner = anchor + QPointF(kOffset, -height - kOffset);
  corner.setX(std::clamp(corner.x(), 4.0, std::max(4.0, size.width() - width - 4.0)));
  corner.setY(std::clamp(corner.y(), 4.0, std::max(4.0, size.height() - height - 4.0)));
  const QRectF card(corner, QSizeF(width, height));
  painter.setPen(QPen(qt(colors.text_dim), 1));
  painter.drawLine(anchor, card.bottomLeft());
  painter.setPen(QPen(qt(colors.panel_edge), 1));
  painter.setBrush(qt(colors.panel, 225));
  painter.drawRoundedRect(card, 4, 4);
  painter.setPen(qt(colors.text));
  painter.setFont(title);
  painter.drawText(corner + QPointF(kPadding, 0.6 * kPadding + title_metrics.ascent()),
                   label.title);
  painter.setPen(qt(colors.text_dim));
  painter.setFont(detail);
  painter.drawText(
      corner + QPointF(kPadding, 0.8 * kPadding + title_metrics.height() + detail_metrics.ascent()),
      label.detail);
}

void paintPlaceNames(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                     const SceneColors& colors, const QSize& size) {
  painter.setPen(qt(colors.text_dim));
  for (const FirePlaceInfo& place : snapshot.places) {
    const bool named_by_fire =
        snapshot.layer(SceneLayer::Fire).visible &&
        std::any_of(snapshot.fires.begin(), snapshot.fires.end(),
                    [&](const FireEstimate& fire) { return fire.place == place.name; });
    if (named_by_fire) continue;
    const auto p =
        camera.project(place.p_map + Eigen::Vector3d(0, 0, 0.5), size.width(), size.height());
    if (!p) continue;
    const QString name = QString::fromStdString(place.name) +
                         (place.visited ? QStringLiteral(" · visited") : QString());
    const double width = QFontMetricsF(painter.font()).horizontalAdvance(name);
    painter.drawText(QPointF(p->x() - 0.5 * width, p->y()), name);
  }
}

void paintGhostText(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                    const SceneColors& colors, const QSize& size) {
  const LayerState& robot = snapshot.layer(SceneLayer::Robot);
  if (!robot.visible || !snapshot.robot_known || robot.freshness != Freshness::Stale) return;
  const Eigen::Vector3d above(snapshot.X_map_base.x_m, snapshot.X_map_base.y_m, 1.9);
  const auto p = camera.project(above, size.width(), size.height());
  if (!p) return;
  const QString text = QStringLiteral("last heard %1 s").arg(robot.age_s, 0, 'f', 1);
  painter.setFont(scaled(painter.font(), 1.1, true));
  const QFontMetricsF metrics(painter.font());
  const QRectF box(p->x() - 0.5 * metrics.horizontalAdvance(text) - kPadding,
                   p->y() - metrics.height(), metrics.horizontalAdvance(text) + 2 * kPadding,
                   metrics.height() + 4);
  painter.setPen(QPen(qt(colors.caution), 1));
  painter.setBrush(qt(colors.panel, 225));
  painter.drawRoundedRect(box, 4, 4);
  painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace

FireLabel fireLabel(const FireEstimate& fire) {
  const QString name =
      fire.place.empty() ? QStringLiteral("heat source") : QString::fromStdString(fire.place);
  const double spread = twoSigma_m(fire.covariance);
  const QString plus_minus =
      std::isfinite(spread)
          ? QStringLiteral("±%1 cm").arg(100.0 * spread, 0, 'f', spread < 0.0995 ? 1 : 0)
          : QStringLiteral("± unknown");
  FireLabel label;
  label.title =
      QStringLiteral("%1 · %2 m · %3").arg(name).arg(fire.range_m, 0, 'f', 2).arg(plus_minus);
  label.detail = QStringLiteral("%1 °C peak, %2 views")
                     .arg(fire.peak_k - kZeroCelsius_k, 0, 'f', 0)
                     .arg(fire.views);
  const double factor = ellipsoidExaggeration(fire);
  if (factor > 1.0) label.detail += QStringLiteral(", 2σ drawn ×%1").arg(factor, 0, 'f', 0);
  return label;
}

void paintSceneLabels(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                      const SceneColors& colors, const QSize& size) {
  const QFont base = painter.font();
  painter.setRenderHint(QPainter::Antialiasing);
  if (snapshot.layer(SceneLayer::Places).visible) {
    painter.setFont(scaled(base, 0.92, false));
    paintPlaceNames(painter, snapshot, camera, colors, size);
  }
  painter.setFont(base);
  if (snapshot.layer(SceneLayer::Fire).visible) {
    for (const FireEstimate& fire : snapshot.fires) {
      if (!fire.p_map.allFinite()) continue;
      const auto p = camera.project(fire.p_map, size.width(), size.height());
      painter.setFont(base);
      if (!p) continue;
      paintTarget(painter, {p->x(), p->y()}, colors, snapshot.layer(SceneLayer::Fire).freshness);
      paintCard(painter, {p->x(), p->y()}, fireLabel(fire), colors, size);
    }
  }
  painter.setFont(base);
  paintGhostText(painter, snapshot, camera, colors, size);
}

}  // namespace kiln::gui
