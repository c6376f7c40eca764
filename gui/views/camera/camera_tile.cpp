#include "gui/views/camera/camera_tile.h"

#include <QPainter>
#include <algorithm>

#include "gui/widgets/hatch.h"

namespace kiln::gui {
namespace {
constexpr int kNoteMargin_px = 14;
}

CameraTile::CameraTile(const Ui& ui, StationModels& models, QWidget* parent)
    : Tile(ui, tr("Camera · operator"), parent),
      ui_(ui),
      models_(models),
      picture_(new CameraPicture(ui, feed_)) {
  setContent(picture_, true);
  connect(&models_.link, &Link::image, this,
          [this](const RgbImagePtr& image) { feed_.accept(image, ui_.clock.now()); });
  connect(&models_.camera, &Model::changed, this, &CameraTile::refresh);
  connect(&models_, &StationModels::aged, this, &CameraTile::refresh);
  refresh();
}

void CameraTile::refresh() {
  const double age_s = models_.camera.ageS();
  feed_.judge(ui_.clock.now(), age_s);
  // The picture crosses itself out with its own words, so the tile's general hatch stays off.
  setAge(age_s, feed_.state() == CameraState::Live        ? AgeLevel::Fresh
                : feed_.state() == CameraState::NoPicture ? AgeLevel::None
                                                          : AgeLevel::Amber);
  const QString rate =
      models_.camera.hasData() ? tr("%1 Hz").arg(models_.camera.rateHz(), 0, 'f', 1) : QString();
  setInfo(feed_.state() == CameraState::Late ? tr("%1 · late").arg(rate) : rate);
  picture_->update();
}

CameraPicture::CameraPicture(const Ui& ui, const CameraFeed& feed, QWidget* parent)
    : QWidget(parent), ui_(ui), feed_(feed) {
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void CameraPicture::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Palette& p = ui_.theme.colors();
  painter.fillRect(rect(), p.sunk);
  const QImage& picture = feed_.picture();
  QRectF area = rect();
  if (!picture.isNull()) {
    const QSizeF fitted = QSizeF(picture.size()).scaled(rect().size(), Qt::KeepAspectRatio);
    area = QRectF(QPointF(0.5 * (width() - fitted.width()), 0.5 * (height() - fitted.height())),
                  fitted);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(area, picture);
  }
  if (feed_.crossedOut()) paintCrossedOut(painter, area);
  if (feed_.crossedOut() || feed_.state() == CameraState::NoPicture)
    paintNote(painter, rect(), feed_.headline(), feed_.advice());
}

void CameraPicture::paintCrossedOut(QPainter& painter, const QRectF& area) const {
  const Palette& p = ui_.theme.colors();
  QColor veil = p.panel;
  veil.setAlphaF(0.55F);
  painter.fillRect(area, veil);
  QColor stripe = p.caution;
  stripe.setAlphaF(0.4F);
  paintHatch(painter, area, stripe);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(p.caution, 2.0));
  painter.drawLine(area.topLeft(), area.bottomRight());
  painter.drawLine(area.topRight(), area.bottomLeft());
}

void CameraPicture::paintNote(QPainter& painter, const QRectF& area, const QString& headline,
                              const QString& advice) const {
  const Palette& p = ui_.theme.colors();
  const bool quiet = feed_.state() == CameraState::NoPicture;
  const QFont strong = ui_.theme.font(TextRole::Strong), small = ui_.theme.font(TextRole::Small);
  const QFontMetricsF strong_metrics(strong), small_metrics(small);
  const double w =
      std::max(strong_metrics.horizontalAdvance(headline), small_metrics.horizontalAdvance(advice));
  const double h = strong_metrics.height() + (advice.isEmpty() ? 0.0 : small_metrics.height());
  QRectF box(0, 0, std::min(w + 2 * kNoteMargin_px, area.width() - 6), h + kNoteMargin_px);
  box.moveCenter(area.center());
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(quiet ? p.border : p.caution, 1.2));
  painter.setBrush(p.panel);
  painter.drawRoundedRect(box, 3, 3);
  const QRectF inner = box.adjusted(4, kNoteMargin_px / 2, -4, -kNoteMargin_px / 2);
  painter.setPen(quiet ? p.dim : p.caution);
  painter.setFont(strong);
  painter.drawText(inner, Qt::AlignTop | Qt::AlignHCenter,
                   strong_metrics.elidedText(headline, Qt::ElideRight, inner.width()));
  painter.setPen(p.dim);
  painter.setFont(small);
  painter.drawText(inner, Qt::AlignBottom | Qt::AlignHCenter,
                   small_metrics.elidedText(advice, Qt::ElideRight, inner.width()));
}

}  // namespace kiln::gui
