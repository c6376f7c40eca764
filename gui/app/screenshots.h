#pragma once

#include <QDir>
#include <QImage>
#include <QTimer>
#include <QWidget>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "gui/models/station_models.h"

namespace kiln::gui {

/// Saves a picture of the window at each new state (NN-StateName.png) and at the end of the mission
/// (NN-mission-end.png). Encoding and writing run on a thread of their own.
class Screenshots : public QObject {
  Q_OBJECT
 public:
  /// A state is pictured this long after it was entered, so that its own data shows.
  static constexpr int kDelay_ms = 700;
  Screenshots(QWidget& window, StationModels& models, const QDir& folder,
              QObject* parent = nullptr);
  ~Screenshots() override;  ///< waits until all files are written
  [[nodiscard]] int taken() const { return count_; }
  void save(const QString& name);
  /// Waits for the writer. False if a file could not be written (told on stderr as well).
  bool finish();

 private:
  struct Picture {
    QString file;
    QImage image;
  };
  void onState(const QString& name);
  void takePending();
  void write(std::stop_token stop);
  QWidget& window_;
  StationModels& models_;
  QDir folder_;
  QTimer timer_;
  QString pending_;
  int count_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<Picture> waiting_;
  std::jthread writer_;
};

}  // namespace kiln::gui
