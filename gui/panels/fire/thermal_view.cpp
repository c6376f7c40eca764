#include "gui/panels/fire/thermal_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "gui/widgets/label_layout.h"

namespace kiln::gui {
namespace {

constexpr int kBar_px = 13, kBarGap_px = 8, kBarText_px = 84;
constexpr int kBarNumber_px = 34;           // in a narrow tile: bare numbers
constexpr std::uint64_t kSeqTolerance = 6;  // detections trail the picture by a few frames at most

QRectF blobRect(const HeatBlob& blob, const QRectF& picture, double pixel) {
  return {picture.left() + blob.u_min * pixel, picture.top() + blob.v_min * pixel,
          (blob.u_max - blob.u_min + 1) * pixel, (blob.v_max - blob.v_min + 1) * pixel};
}

/// Text on a dark plate, readable over every colour of the map.
void paintPlate(QPainter& painter, const QRectF& box, const QString& text, const QColor& color) {
  painter.fillRect(box, QColor(0, 0, 0, 165));
  painter.setPen(color);
  painter.drawText(box, Qt::AlignCenter, text);
}

const QColor kAccepted(Qt::white), kRejected(0xb8, 0xc4, 0xcc);

QString blobText(const HeatBlob& blob) {
  if (blob.rejection == HeatRejection::None)
    return ThermalView::tr("%1 °C").arg(toCelsius(blob.peak_k), 0, 'f', 0);
  const auto why = toString(blob.rejection);
  return QString::fromUtf8(why.data(), static_cast<int>(why.size()));
}

void paintBox(QPainter& painter, const QRectF& box, bool accepted) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(Qt::black, accepted ? 4.0 : 2.6));
  painter.drawRect(box);
  painter.setPen(accepted ? QPen(kAccepted, 2.0) : QPen(kRejected, 1.0, Qt::DashLine));
  painter.drawRect(box);
}

void paintLeader(QPainter& painter, const QLineF& line, const QColor& color) {
  painter.setPen(QPen(Qt::black, 3.0));
  painter.drawLine(line);
  painter.setPen(QPen(color, 1.2));
  painter.drawLine(line);
}

}  // namespace

ThermalView::ThermalView(const Ui& ui, QWidget* parent) : QWidget(parent), ui_(ui) {
  setMouseTracking(true);
  setCursor(Qt::CrossCursor);
  connect(&ui_.theme, &Theme::changed, this, qOverload<>(&QWidget::update));
}

void ThermalView::show(const ThermalImagePtr& image,
                       const std::shared_ptr<const HeatDetections>& heat, const QString& notice) {
  const bool other = image != image_;
  image_ = image;
  heat_ = heat;
  notice_ = notice;
  if (other) recolor();
  if (mouse_) emit hovered(readingAt(*mouse_));
  update();
}

void ThermalView::setMarks(std::vector<PlacedMark> marks) {
  marks_ = std::move(marks);
  update();
}

void ThermalView::setAutomaticScale(bool automatic) {
  automatic_ = automatic;
  recolor();
  update();
}

void ThermalView::recolor() {
  if (!image_) {
    colors_ = QImage();
    return;
  }
  scale_ = automatic_ && hasTemperatures(*image_) ? ThermalScale::fitted(*image_) : ThermalScale{};
  colors_ = colorize(*image_, scale_, map_);
}

int ThermalView::barText() const { return compact_ ? kBarNumber_px : kBarText_px; }

void ThermalView::setCompact(bool compact) {
  if (compact == compact_) return;
  compact_ = compact;
  update();
}

QRectF ThermalView::pictureRect() const {
  const int w = image_ && image_->width > 0 ? image_->width : 160,
            h = image_ && image_->height > 0 ? image_->height : 120;
  const double pixel = std::min(static_cast<double>(width() - kBar_px - kBarGap_px - barText()) / w,
                                static_cast<double>(height()) / h);
  return {0.0, 0.5 * (height() - pixel * h), pixel * w, pixel * h};
}

QString ThermalView::readingAt(const QPoint& p) const {
  if (!image_ || colors_.isNull()) return {};
  const QRectF picture = pictureRect();
  const double pixel = picture.width() / image_->width;
  const int u = static_cast<int>(std::floor((p.x() - picture.left()) / pixel));
  const int v = static_cast<int>(std::floor((p.y() - picture.top()) / pixel));
  if (u < 0 || v < 0 || u >= image_->width || v >= image_->height) return {};
  const auto celsius = celsiusAt(*image_, u, v);
  if (!celsius) return tr("no temperature at (%1, %2)").arg(u).arg(v);
  return tr("%1 °C at (%2, %3)").arg(*celsius, 0, 'f', 1).arg(u).arg(v);
}

void ThermalView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const QRectF picture = pictureRect();
  const Palette& p = ui_.theme.colors();
  if (colors_.isNull()) {
    painter.fillRect(picture, p.sunk);
  } else {
    painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
    painter.drawImage(picture, colors_);
    painter.setFont(ui_.theme.font(TextRole::Small));
    paintBlobs(painter, picture);
    paintPictureMarks(painter, marks_, picture, ui_.theme);
    if (hasTemperatures(*image_)) paintBar(painter, picture);
  }
  if (!notice_.isEmpty()) paintNotice(painter, picture);
  if (mouse_) paintReading(painter, picture);
}

void ThermalView::paintBlobs(QPainter& painter, const QRectF& picture) const {
  if (!heat_ || !heat_->usable) return;
  const auto gap = image_->seq > heat_->image_seq ? image_->seq - heat_->image_seq
                                                  : heat_->image_seq - image_->seq;
  if (gap > kSeqTolerance) return;
  // The accepted ones first: they get the best places, and are painted last, on top.
  std::vector<const HeatBlob*> blobs;
  for (const HeatBlob& blob : heat_->blobs) blobs.push_back(&blob);
  std::stable_partition(blobs.begin(), blobs.end(), [](const HeatBlob* blob) {
    return blob->rejection == HeatRejection::None;
  });
  const double pixel = picture.width() / image_->width;
  std::vector<LabelWish> wishes;
  for (const HeatBlob* blob : blobs) {
    const QFontMetricsF metrics(labelFont(*blob));
    wishes.push_back({blobRect(*blob, picture, pixel),
                      {metrics.horizontalAdvance(blobText(*blob)) + 8, metrics.height() + 1}});
  }
  const auto places = placeLabels(wishes, picture);
  for (std::size_t i = blobs.size(); i-- > 0;)
    paintBox(painter, wishes[i].target, blobs[i]->rejection == HeatRejection::None);
  for (std::size_t i = blobs.size(); i-- > 0;) {
    if (!places[i]) continue;  // no room is left: the list beside the picture counts it
    const QColor color = blobs[i]->rejection == HeatRejection::None ? kAccepted : kRejected;
    if (places[i]->leader) paintLeader(painter, *places[i]->leader, color);
    painter.setFont(labelFont(*blobs[i]));
    paintPlate(painter, places[i]->plate, blobText(*blobs[i]), color);
  }
}

QFont ThermalView::labelFont(const HeatBlob& blob) const {
  QFont font = ui_.theme.font(TextRole::Small);
  font.setBold(blob.rejection == HeatRejection::None);
  return font;
}

void ThermalView::paintBar(QPainter& painter, const QRectF& picture) const {
  const Palette& p = ui_.theme.colors();
  const QFontMetricsF metrics(painter.font());
  painter.setFont(ui_.theme.font(TextRole::Small));
  const QRectF bar(picture.right() + kBarGap_px, picture.top(), kBar_px, picture.height());
  const int rows = static_cast<int>(bar.height());
  for (int y = 0; y < rows; ++y) {
    const Rgb c = map_.at(1.0 - static_cast<double>(y) / std::max(1, rows - 1));
    painter.fillRect(QRectF(bar.left(), bar.top() + y, bar.width(), 1.5), QColor(c.r, c.g, c.b));
  }
  const auto text = [&](double y, const QString& s, const QColor& color, Qt::Alignment align) {
    painter.setPen(color);
    painter.drawText(QRectF(bar.right() + 5, y - 8, barText(), 16), align | Qt::AlignLeft, s);
  };
  const QString unit = compact_ ? tr("%1°") : tr("%1 °C");
  text(bar.top() + 8, unit.arg(scale_.high_c, 0, 'f', 0), p.dim, Qt::AlignVCenter);
  text(bar.bottom() - 8, unit.arg(scale_.low_c, 0, 'f', 0), p.dim, Qt::AlignVCenter);
  if (scale_.automatic)
    text(bar.top() + 24, compact_ ? tr("AUTO") : tr("AUTO scale"), p.caution, Qt::AlignVCenter);
  if (!heat_ || heat_->threshold_k <= 0.0) return;
  const double threshold_c = toCelsius(heat_->threshold_k);
  const double y = bar.bottom() - scale_.position(threshold_c) * bar.height();
  painter.setPen(QPen(p.text, 1.5));
  painter.drawLine(QPointF(bar.left() - 3, y), QPointF(bar.right() + 3, y));
  text(y, (compact_ ? tr("%1°") : tr("%1 threshold")).arg(threshold_c, 0, 'f', 0), p.text,
       Qt::AlignVCenter);
}

void ThermalView::paintNotice(QPainter& painter, const QRectF& picture) const {
  const Palette& p = ui_.theme.colors();
  const QFont font = ui_.theme.font(TextRole::Strong);
  painter.setFont(font);
  const QRectF area = picture.adjusted(10, 10, -10, -10);
  QRectF box = QFontMetricsF(font)
                   .boundingRect(area, Qt::AlignCenter | Qt::TextWordWrap, notice_)
                   .adjusted(-9, -6, 9, 6);
  painter.setPen(QPen(p.caution, 1.2));
  painter.setBrush(p.panel);
  painter.drawRoundedRect(box, 3, 3);
  painter.setPen(p.caution);
  painter.drawText(box, Qt::AlignCenter | Qt::TextWordWrap, notice_);
}

void ThermalView::paintReading(QPainter& painter, const QRectF& picture) const {
  const QString reading = readingAt(*mouse_);
  if (reading.isEmpty()) return;
  const QFontMetricsF metrics(ui_.theme.font(TextRole::Small));
  painter.setFont(ui_.theme.font(TextRole::Small));
  QRectF plate(mouse_->x() + 12, mouse_->y() + 10, metrics.horizontalAdvance(reading) + 10,
               metrics.height() + 3);
  plate.moveRight(std::min(plate.right(), picture.right()));
  plate.moveBottom(std::min(plate.bottom(), picture.bottom()));
  paintPlate(painter, plate, reading, Qt::white);
}

void ThermalView::mouseMoveEvent(QMouseEvent* event) {
  mouse_ = event->pos();
  emit hovered(readingAt(event->pos()));
  update();
}

void ThermalView::leaveEvent(QEvent*) {
  mouse_.reset();
  emit hovered({});
  update();
}

}  // namespace kiln::gui
