#include "gui/views/camera/picture_marks.h"

#include <QPainter>
#include <algorithm>

#include "common/geom/camera_model.h"
#include "gui/widgets/fitted_text.h"

namespace kiln::gui {

namespace {
constexpr double kGap_px = 4.0, kArm_px = 11.0, kBeside_px = 6.0;
constexpr int kNarrow_pct = 82, kMostLines = 3;

void paintMark(QPainter& painter, const QPointF& at, const QString& label, const QRectF& within) {
  for (const auto& [color, width] : {std::pair{QColor(Qt::black), 4.0}, {QColor(Qt::white), 1.8}}) {
    painter.setPen(QPen(color, width, Qt::SolidLine, Qt::FlatCap));
    for (const QPointF& d : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
      painter.drawLine(at + kGap_px * d, at + kArm_px * d);
  }
  // Never beside the picture: a small one has it in several lines.
  const QFont font = painter.font();
  const int room = static_cast<int>(within.width()) - 8;
  FittedText words = fitText(label, {font}, room, 1);
  if (!words.whole) words = fitText(label, {font, condensed(font, kNarrow_pct)}, room, kMostLines);
  const QFontMetricsF metrics(words.font);
  double width = 8;
  for (const QString& line : words.lines)
    width = std::max(width, metrics.horizontalAdvance(line) + 8);
  QRectF box(at.x() + kBeside_px, at.y() + kBeside_px, width, words.height() + 1);
  box.moveLeft(
      std::clamp(box.left(), within.left(), std::max(within.left(), within.right() - box.width())));
  box.moveTop(std::min(box.top(), within.bottom() - box.height()));
  painter.fillRect(box, QColor(0, 0, 0, 165));
  painter.setPen(Qt::white);
  paintFitted(painter, box, Qt::AlignCenter, words);
  painter.setFont(font);
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
