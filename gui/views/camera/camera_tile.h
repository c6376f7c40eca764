#pragma once

#include "gui/models/station_models.h"
#include "gui/views/camera/camera_feed.h"
#include "gui/widgets/tile.h"

namespace kiln::gui {

class CameraPicture;

/// The operator camera as a tile.
class CameraTile : public Tile {
  Q_OBJECT
 public:
  CameraTile(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] const CameraFeed& feed() const { return feed_; }

 private:
  void refresh();
  Ui ui_;
  StationModels& models_;
  CameraFeed feed_;
  CameraPicture* picture_;
};

/// The picture alone: keeps its aspect; crossed out with the reason when nothing may be steered by
/// it.
class CameraPicture : public QWidget {
  Q_OBJECT
 public:
  CameraPicture(const Ui& ui, const CameraFeed& feed, QWidget* parent = nullptr);
  [[nodiscard]] QSize minimumSizeHint() const override { return {180, 100}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintCrossedOut(QPainter& painter, const QRectF& area) const;
  void paintNote(QPainter& painter, const QRectF& area, const QString& headline,
                 const QString& advice) const;
  Ui ui_;
  const CameraFeed& feed_;
};

}  // namespace kiln::gui
