#include "gui/views/scene3d/scene_labels.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "gui/views/scene3d/orbit_camera.h"
#include "gui/views/scene3d/scene_actor.h"
#include "gui/widgets/age_badge.h"

namespace kiln::gui {
namespace {

constexpr int kPadding = 7, kOffset = 26;
constexpr double kRing_px = 9.0;
constexpr double kFinger_px = 24.0;

QColor qt(Rgb c, int alpha = 255) { return {c.r, c.g, c.b, alpha}; }

QFont scaled(const QFont& base, double factor, bool bold) {
  QFont font = base;
  font.setPointSizeF(std::max(9.0, base.pointSizeF() * factor));
  font.setBold(bold);
  return font;
}

/// A ring round the estimate: it would otherwise hide behind what stands before it.
void paintTarget(QPainter& painter, const QPointF& at, const QColor& color) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(color, 2.0));
  painter.drawEllipse(at, kRing_px, kRing_px);
  for (const QPointF& d : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
    painter.drawLine(at + kRing_px * d, at + (kRing_px + 5.0) * d);
}

/// A small card with a leader line to its anchor.
void paintCard(QPainter& painter, const QPointF& anchor, const ItemCard& label,
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

void paintName(QPainter& painter, const QPointF& at, const QString& name) {
  const double width = QFontMetricsF(painter.font()).horizontalAdvance(name);
  painter.drawText(QPointF(at.x() - 0.5 * width, at.y()), name);
}

void paintGhostText(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                    const SceneColors& colors, const QSize& size) {
  const LayerState& robot = snapshot.layer(SceneLayer::Robot);
  if (!robot.visible || !snapshot.robot_known || robot.freshness != Freshness::Stale) return;
  const Eigen::Vector3d above(snapshot.X_map_base.x_m, snapshot.X_map_base.y_m, 1.9);
  const auto p = camera.project(above, size.width(), size.height());
  if (!p) return;
  const QString text = QStringLiteral("last heard %1 ago").arg(ageText(robot.age_s));
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

ItemCard itemCard(const SceneItem& item) {
  ItemCard card{QString::fromStdString(item.label), QString::fromStdString(item.detail)};
  const double factor =
      item.shape == SceneItem::Shape::Estimate ? ellipsoidExaggeration(item.covariance) : 1.0;
  if (factor > 1.0) card.detail += QStringLiteral(", 2σ drawn ×%1").arg(factor, 0, 'f', 0);
  return card;
}

const SceneItem* itemAt(const SceneSnapshot& snapshot, const OrbitCamera& camera, const QSize& size,
                        const QPointF& at) {
  const SceneItem* nearest = nullptr;
  double best_px = kFinger_px;
  for (const SceneItem& item : snapshot.items) {
    if (item.label.empty() || !snapshot.layer(item.layer).visible) continue;
    const auto p = camera.project(item.X_map_item.translation(), size.width(), size.height());
    if (!p) continue;
    const double away_px = std::hypot(p->x() - at.x(), p->y() - at.y());
    if (away_px > best_px) continue;
    best_px = away_px;
    nearest = &item;
  }
  return nearest;
}

void paintSceneLabels(QPainter& painter, const SceneSnapshot& snapshot, const OrbitCamera& camera,
                      const SceneColors& colors, const QSize& size) {
  const QFont base = painter.font();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const SceneItem& item : snapshot.items) {
    const LayerState& layer = snapshot.layer(item.layer);
    if (!layer.visible || item.label.empty()) continue;
    const auto p = camera.project(item.X_map_item.translation(), size.width(), size.height());
    if (!p) continue;
    const QPointF at(p->x(), p->y());
    if (item.detail.empty()) {
      painter.setFont(scaled(base, 0.92, false));
      painter.setPen(qt(colors.text_dim));
      paintName(painter, at, QString::fromStdString(item.label));
      continue;
    }
    painter.setFont(base);
    if (item.shape == SceneItem::Shape::Estimate)
      paintTarget(painter, at, qt(agedColor(colors.item(item.style), layer.freshness, colors)));
    paintCard(painter, at, itemCard(item), colors, size);
  }
  painter.setFont(base);
  paintGhostText(painter, snapshot, camera, colors, size);
}

}  // namespace kiln::gui
