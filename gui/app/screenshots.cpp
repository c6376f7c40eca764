#include "gui/app/screenshots.h"

#include <QPixmap>
#include <iostream>

namespace kiln::gui {

Screenshots::Screenshots(QWidget& window, StationModels& models, const QDir& folder,
                         QObject* parent)
    : QObject(parent), window_(window), models_(models), folder_(folder) {
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, [this] {
    save(std::exchange(pending_, QString{}));
    const FsmStatus* status = models_.fsm.status();
    if (!status || !status->terminal) return;
    save(QStringLiteral("mission-end"));
    emit missionEnded();
  });
  connect(&models_.fsm, &FsmModel::stateEntered, this, &Screenshots::onState);
  if (!models_.fsm.current().isEmpty()) onState(models_.fsm.current());
}

void Screenshots::onState(const QString& name) {
  // A state that passes more quickly than the delay gets its picture at its end.
  if (timer_.isActive() && !pending_.isEmpty()) save(pending_);
  pending_ = name;
  timer_.start(kDelay_ms);
}

bool Screenshots::save(const QString& name) {
  const QString file = folder_.filePath(
      QStringLiteral("%1-%2.png").arg(++count_, 2, 10, QLatin1Char('0')).arg(name));
  if (window_.grab().save(file)) return true;
  std::cerr << "kiln-station: cannot write " << file.toStdString()
            << "; is the disk full or the folder read-only?\n";
  return false;
}

}  // namespace kiln::gui
