#include "gui/views/scene3d/layer_panel.h"

#include <QMouseEvent>
#include <QPainter>

#include "gui/widgets/age_badge.h"
#include "gui/widgets/text.h"

namespace kiln::gui {
namespace {
constexpr int kRow_px = 21, kMargin_px = 7, kWidth_px = 172, kDot_px = 8;

bool looksOld(const LayerState& layer) {
  return layer.freshness == Freshness::Aging || layer.freshness == Freshness::Stale;
}
}  // namespace

LayerPanel::LayerPanel(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  setMouseTracking(true);
  setCursor(Qt::PointingHandCursor);
  setTip(*this, tr("show or hide a layer"));
  resize(sizeHint());
}

QSize LayerPanel::sizeHint() const {
  return {kWidth_px, 2 * kMargin_px + kRow_px * static_cast<int>(rows_.size())};
}

void LayerPanel::show(const SceneSnapshot& snapshot) {
  rows_.clear();
  for (std::size_t i = 0; i < kSceneLayers; ++i) {
    const QByteArray label = tr(toString(static_cast<SceneLayer>(i))).toUtf8();
    rows_.push_back({{"", label.toStdString()}, snapshot.layers[i]});
  }
  rows_.insert(rows_.end(), snapshot.mission_layers.begin(), snapshot.mission_layers.end());
  if (size() != sizeHint()) resize(sizeHint());
  update();
}

QRect LayerPanel::row(int index) const {
  return {0, kMargin_px + index * kRow_px, width(), kRow_px};
}

int LayerPanel::rowAt(const QPoint& p) const {
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i)
    if (row(i).contains(p)) return i;
  return -1;
}

void LayerPanel::paintEvent(QPaintEvent*) {
  const Palette& p = ui_.theme.colors();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QColor ground = p.panel;
  ground.setAlpha(225);
  painter.setPen(QPen(p.border, 1));
  painter.setBrush(ground);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
  painter.setFont(ui_.theme.font(TextRole::Small));
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
    const auto& [spec, layer] = rows_[static_cast<std::size_t>(i)];
    const QRect r = row(i);
    if (i == hovered_) painter.fillRect(r.adjusted(2, 0, -2, 0), p.raised);
    const bool shown = layer.visible;
    const bool old = shown && looksOld(layer);
    const QColor color = !shown || layer.freshness == Freshness::Missing ? p.faint
                         : old                                           ? p.caution
                                                                         : p.text;
    painter.setPen(QPen(color, 1.3));
    painter.setBrush(shown ? QBrush(color) : QBrush(Qt::NoBrush));
    painter.drawEllipse(QPointF(kMargin_px + kDot_px, r.center().y() + 1), kDot_px / 2.0,
                        kDot_px / 2.0);
    const QRect text = r.adjusted(kMargin_px + 2 * kDot_px + 2, 0, -kMargin_px, 0);
    painter.drawText(text, Qt::AlignVCenter | Qt::AlignLeft, QString::fromStdString(spec.label));
    const QString note = layer.freshness == Freshness::Missing ? tr("none")
                         : old ? tr("%1 old").arg(ageText(layer.age_s))
                               : QString();
    painter.drawText(text, Qt::AlignVCenter | Qt::AlignRight, note);
  }
}

void LayerPanel::mousePressEvent(QMouseEvent* event) {
  const int index = rowAt(event->pos());
  if (index < 0) return;
  auto& [spec, layer] = rows_[static_cast<std::size_t>(index)];
  layer.visible = !layer.visible;
  update();
  if (index < static_cast<int>(kSceneLayers)) {
    emit toggled(static_cast<SceneLayer>(index), layer.visible);
  } else {
    emit missionToggled(spec.id, layer.visible);
  }
}

void LayerPanel::mouseMoveEvent(QMouseEvent* event) {
  hovered_ = rowAt(event->pos());
  update();
}

void LayerPanel::leaveEvent(QEvent*) {
  hovered_ = -1;
  update();
}

}  // namespace kiln::gui
