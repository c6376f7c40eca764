#include "gui/models/localization_model.h"

#include <QStringList>
#include <cmath>

#include "common/core/units.h"

namespace kiln::gui {

QString lengthText(double metres) {
  const double size = std::abs(metres);
  if (size < 0.00995) return QStringLiteral("%1 mm").arg(1000.0 * metres, 0, 'f', 0);
  if (size < 0.0995) return QStringLiteral("%1 cm").arg(100.0 * metres, 0, 'f', 1);
  if (size < 0.995) return QStringLiteral("%1 cm").arg(100.0 * metres, 0, 'f', 0);
  return QStringLiteral("%1 m").arg(metres, 0, 'f', size < 9.95 ? 1 : 0);
}

QString angleText(double radians) {
  const double degrees = radians / kDeg;
  return QStringLiteral("%1°").arg(degrees, 0, 'f', std::abs(degrees) < 9.95 ? 1 : 0);
}

LocalizationModel::LocalizationModel(Link& link, QObject* parent)
    : Model(link, AgeLimits{}, parent) {
  connect(&link, &Link::localization, this,
          [this](std::shared_ptr<const LocalizationStatus> status) {
            status_ = std::move(status);
            arrived(status_->stamp);
          });
}

QString LocalizationModel::summary() const {
  if (!status_ || ageLevel() != AgeLevel::Fresh) return tr("unknown");
  if (status_->health == LocalizationHealth::Lost) return tr("lost");
  const QString word = status_->health == LocalizationHealth::Good ? tr("good") : tr("degraded");
  return tr("%1 ±%2 ±%3")
      .arg(word, lengthText(status_->sigma_m), angleText(status_->sigma_yaw_rad));
}

QString LocalizationModel::details() const {
  if (!status_) return tr("The robot has not told where it is.");
  QStringList lines;
  if (!status_->reason.empty()) lines << QString::fromStdString(status_->reason);
  lines << tr("by %1%2").arg(QString::fromStdString(status_->method),
                             status_->submap.empty()
                                 ? QString()
                                 : tr(", %1 map").arg(QString::fromStdString(status_->submap)));
  lines << (status_->match_age_s < 0
                ? tr("no scan has been matched yet")
                : tr("last match %1 s ago, %2 % of the points, %3 of 6 directions seen")
                      .arg(status_->match_age_s, 0, 'f', 1)
                      .arg(100.0 * status_->inlier_fraction, 0, 'f', 0)
                      .arg(status_->observable_directions));
  if (status_->tracking_error_m)
    lines << tr("%1 off the path").arg(lengthText(*status_->tracking_error_m));
  lines << tr("± is one standard deviation");
  return lines.join(QLatin1Char('\n'));
}

MapModel::MapModel(Link& link, QObject* parent) : Model(link, kSlowAge, parent) {
  connect(&link, &Link::mapLayer, this, [this](std::shared_ptr<const MapLayer> layer) {
    const bool same = layer_ && layer_->version == layer->version &&
                      layer_->points_map.size() == layer->points_map.size();
    if (same) return;  // repeated for stations that came later
    layer_ = std::move(layer);
    arrived(layer_->stamp);
  });
  connect(&link, &Link::trajectory, this, [this](std::shared_ptr<const Trajectory> trajectory) {
    trajectory_ = std::move(trajectory);
    touch();
  });
}

}  // namespace kiln::gui
