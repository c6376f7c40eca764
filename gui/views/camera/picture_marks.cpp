#include "gui/views/camera/picture_marks.h"

#include <QPainter>
#include <algorithm>

#include "common/geom/camera_model.h"

namespace kiln::gui {

namespace {
constexpr double kGap_px = 4.0, kArm_px = 11.0, kBeside_px = 6.0;

void paintMark(QPainter& painter, const QPointF& at, const QString& label, const QRectF& within) {
  for (const auto& [color, width] : {std::pair{QColor(Qt::black), 4.0}, {QColor(Qt::white), 1.8}}) {
    painter.setPen(QPen(color, width, Qt::SolidLine, Qt::FlatCap));
    for (const QPointF& d : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
      painter.drawLine(at + kGap_px * d, at + kArm_px * d);
  }
  const QFontMetricsF metrics(painter.font());
  // In a small picture the label takes several lines rather than end outside.
  const QRectF room(0, 0, within.width() - 8, within.height());
  const QSizeF text = metrics.boundingRect(room, Qt::TextWordWrap, label).size();
  QRectF box(at + QPointF(kBeside_px, kBeside_px), text + QSizeF(8, 1));
  box.moveLeft(
      std::clamp(box.left(), within.left(), std::max(within.left(), within.right() - box.width())));
  box.moveTop(std::min(box.top(), within.bottom() - box.height()));
  painter.fillRect(box, QColor(0, 0, 0, 165));
  painter.setPen(Qt::white);
  painter.drawText(box, Qt::AlignCenter | Qt::TextWordWrap, label);
}
}  // namespace

std::optional<QPointF> placeInPicture(const Eigen::Vector3d& p_map,
                                      const Eigen::Isometry3d& X_map_camera, double hfov_rad,
                                      const QSize& picture) {
  if (picture.isEmpty()) return std::nullopt;
  const CameraModel camera =
      CameraModel::fromHorizontalFov(picture.width(), picture.height(), hfov_rad);
  const auto pixel = camera.project(X_map_camera.inverse() * p_map);
  if (!pixel) return std::nullopt;
  // Pixel (0, 0) is the centre of the first one.
  const QPointF share((pixel->x() + 0.5) / picture.width(), (pixel->y() + 0.5) / picture.height());
  const bool inside = share.x() >= 0 && share.x() <= 1 && share.y() >= 0 && share.y() <= 1;
  return inside ? std::optional(share) : std::nullopt;
}

void paintPictureMarks(QPainter& painter, const std::vector<PlacedMark>& marks,
                       const QRectF& picture, const Theme& theme) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(theme.font(TextRole::Small));
  for (const PlacedMark& mark : marks) {
    const QPointF at(mark.share.x() * picture.width(), mark.share.y() * picture.height());
    paintMark(painter, picture.topLeft() + at, mark.label, picture);
  }
  painter.restore();
}

}  // namespace kiln::gui
