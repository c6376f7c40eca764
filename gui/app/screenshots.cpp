#include "gui/app/screenshots.h"

#include <QPixmap>
#include <iostream>
#include <utility>

namespace kiln::gui {

Screenshots::Screenshots(QWidget& window, StationModels& models, const QDir& folder,
                         QObject* parent)
    : QObject(parent),
      window_(window),
      models_(models),
      folder_(folder),
      writer_([this](std::stop_token stop) { write(stop); }) {
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, &Screenshots::takePending);
  connect(&models_.fsm, &FsmModel::stateEntered, this, &Screenshots::onState);
  if (!models_.fsm.current().isEmpty()) onState(models_.fsm.current());
}

Screenshots::~Screenshots() { finish(); }

void Screenshots::takePending() {
  save(std::exchange(pending_, QString{}));
  const FsmStatus* status = models_.fsm.status();
  if (status && status->terminal) save(QStringLiteral("mission-end"));
}

void Screenshots::onState(const QString& name) {
  if (name.isEmpty()) return;  // the robot has told of itself, but not of its mission
  // A state that passes more quickly than the delay gets its picture at its end.
  if (timer_.isActive() && !pending_.isEmpty()) save(pending_);
  pending_ = name;
  timer_.start(kDelay_ms);
}

void Screenshots::save(const QString& name) {
  const QString file = QStringLiteral("%1-%2.png").arg(++count_, 2, 10, QLatin1Char('0')).arg(name);
  QImage image = window_.grab().toImage();
  const std::lock_guard lock(mutex_);
  waiting_.push_back({folder_.filePath(file), std::move(image)});
  wake_.notify_one();
}

bool Screenshots::finish() {
  if (writer_.joinable()) {
    writer_.request_stop();
    writer_.join();
  }
  return !failed_;
}

void Screenshots::write(std::stop_token stop) {
  for (;;) {
    Picture picture;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, stop, [this] { return !waiting_.empty(); });
      if (waiting_.empty()) return;  // asked to stop, and all is written
      picture = std::move(waiting_.front());
      waiting_.pop_front();
    }
    if (picture.image.save(picture.file)) continue;
    failed_ = true;
    std::cerr << "kiln-station: cannot write " << picture.file.toStdString()
              << "; is the disk full or the folder read-only?\n";
  }
}

}  // namespace kiln::gui
