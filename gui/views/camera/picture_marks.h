#pragma once

#include <QObject>
#include <QPointF>
#include <QSize>
#include <QString>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "gui/widgets/theme.h"

class QPainter;

namespace kiln::gui {

/// A point of the map to be marked in the pictures.
struct PictureMark {
  Eigen::Vector3d p_map;  ///< metres
  QString label;
};

/// The same, where a camera sees it.
struct PlacedMark {
  QPointF share;  ///< of the picture, from its upper left corner
  QString label;
};

/// What a mission marks in the pictures of the cameras; brought by one of its panels.
class PictureMarks : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;
  /// Of now; empty while nothing is known.
  [[nodiscard]] virtual std::vector<PictureMark> marks() const = 0;

 signals:
  void changed();
};

/// Where a camera sees a point, as shares of its picture from the upper left corner; square pixels,
/// no distortion. nullopt: not in the picture.
/// @param X_map_camera  camera axes X right, Y down, Z viewing.
[[nodiscard]] std::optional<QPointF> placeInPicture(const Eigen::Vector3d& p_map,
                                                    const Eigen::Isometry3d& X_map_camera,
                                                    double hfov_rad, const QSize& picture);

/// A cross with a gap in its middle, and the label beside it; to be read on every ground.
/// @param picture  where it lies in the widget; labels stay inside.
void paintPictureMarks(QPainter& painter, const std::vector<PlacedMark>& marks,
                       const QRectF& picture, const Theme& theme);

}  // namespace kiln::gui
