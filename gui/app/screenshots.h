#pragma once

#include <QDir>
#include <QTimer>
#include <QWidget>

#include "gui/models/station_models.h"

namespace kiln::gui {

/// Saves a picture of the window at each new state (NN-StateName.png) and at the end of the mission
/// (NN-mission-end.png).
class Screenshots : public QObject {
  Q_OBJECT
 public:
  /// A state is pictured this long after it was entered, so that its own data shows.
  static constexpr int kDelay_ms = 700;
  Screenshots(QWidget& window, StationModels& models, const QDir& folder,
              QObject* parent = nullptr);
  [[nodiscard]] int saved() const { return count_; }
  /// Picture of now. False (and a message on stderr) if the file cannot be written.
  bool save(const QString& name);

 signals:
  void missionEnded();  ///< after its last picture

 private:
  void onState(const QString& name);
  QWidget& window_;
  StationModels& models_;
  QDir folder_;
  QTimer timer_;
  QString pending_;
  int count_ = 0;
};

}  // namespace kiln::gui
