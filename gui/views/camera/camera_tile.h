#pragma once

#include "common/robot_model/robot_geometry.h"
#include "gui/models/station_models.h"
#include "gui/views/camera/camera_feed.h"
#include "gui/views/camera/picture_marks.h"
#include "gui/widgets/tile.h"

class QButtonGroup;

namespace kiln::gui {

class CameraPicture;

/// The cameras as a tile: the operator's at the rear top, or the head's. Both streams are judged
/// all the time; one is shown.
class CameraTile : public Tile {
  Q_OBJECT
 public:
  enum Camera { Operator, Head };
  CameraTile(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] const CameraFeed& feed(Camera camera) const { return feeds_[camera]; }
  [[nodiscard]] Camera shown() const { return shown_; }
  void showCamera(Camera camera);
  /// Marks points of the map in the pictures, by the cameras' mountings; the tile owns `marks`.
  /// nullptr: none any more.
  void setMarks(PictureMarks* marks, const RobotGeometry& geometry = {});

 private:
  void accept(const RgbImagePtr& image);
  void refresh();
  void restyle();
  [[nodiscard]] const CameraModel& model(Camera camera) const;
  [[nodiscard]] std::vector<PlacedMark> placedMarks() const;
  QWidget* makeChoice();
  Ui ui_;
  StationModels& models_;
  CameraFeed feeds_[2];
  Camera shown_ = Operator;
  CameraPicture* picture_;
  QButtonGroup* choice_;
  PictureMarks* marks_ = nullptr;
  RobotGeometry geometry_;
};

/// The picture alone: keeps its aspect; crossed out with the reason when nothing may be steered by
/// it.
class CameraPicture : public QWidget {
  Q_OBJECT
 public:
  explicit CameraPicture(const Ui& ui, QWidget* parent = nullptr);
  /// @param feed  outlives this widget, or the next call.
  /// @param marks  not drawn in a picture that is crossed out.
  void show(const CameraFeed& feed, std::vector<PlacedMark> marks = {});
  [[nodiscard]] const std::vector<PlacedMark>& marks() const { return marks_; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {180, 100}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintCrossedOut(QPainter& painter, const QRectF& area) const;
  void paintNote(QPainter& painter, const QRectF& area, const QString& headline,
                 const QString& advice) const;
  Ui ui_;
  const CameraFeed* feed_ = nullptr;
  std::vector<PlacedMark> marks_;
};

}  // namespace kiln::gui
