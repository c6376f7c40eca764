#include "gui/views/camera/camera_feed.h"

#include <QCoreApplication>

namespace kiln::gui {
namespace {

QString tr(const char* text) { return QCoreApplication::translate("CameraFeed", text); }

bool decodable(const RgbImage& image) {
  return image.width > 0 && image.height > 0 &&
         image.data.size() ==
             3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

}  // namespace

void CameraFeed::accept(const RgbImagePtr& image, Stamp now) {
  if (!image) return;
  any_ = true;
  last_message_ = now;
  broken_ = !decodable(*image);
  if (broken_ || image == keep_alive_) return;
  keep_alive_ = image;
  picture_ = QImage(image->data.data(), image->width, image->height, 3 * image->width,
                    QImage::Format_RGB888);
}

void CameraFeed::judge(Stamp now, double age_s) {
  age_s_ = age_s;
  const bool arriving = any_ && toSeconds(now - last_message_) < config_.arriving_s;
  if (!any_)
    state_ = CameraState::NoPicture;
  else if (broken_ && arriving)
    state_ = CameraState::DecodeFailed;
  else if (age_s >= config_.frozen_s)
    state_ = arriving ? CameraState::Stale : CameraState::Stalled;
  else
    state_ = age_s >= config_.late_s ? CameraState::Late : CameraState::Live;
}

bool CameraFeed::crossedOut() const {
  return state_ == CameraState::Stalled || state_ == CameraState::Stale ||
         state_ == CameraState::DecodeFailed;
}

QString CameraFeed::headline() const {
  const bool old = state_ == CameraState::Stalled || state_ == CameraState::Stale;
  if (recorded_ && old) return tr("recorded %1 s before this moment").arg(age_s_, 0, 'f', 1);
  switch (state_) {
    case CameraState::NoPicture:
      return tr("no picture yet");
    case CameraState::Live:
      return {};
    case CameraState::Late:
      return tr("%1 s late").arg(age_s_, 0, 'f', 1);
    case CameraState::Stalled:
      return tr("frozen %1 s ago: no new frames").arg(age_s_, 0, 'f', 1);
    case CameraState::Stale:
      return tr("frames arrive, but show %1 s ago").arg(age_s_, 0, 'f', 1);
    case CameraState::DecodeFailed:
      return tr("frames arrive, but cannot be decoded");
  }
  return {};
}

QString CameraFeed::advice() const {
  if (recorded_) return {};
  switch (state_) {
    case CameraState::Stalled:
      return tr("check cable and link; other views may be live");
    case CameraState::Stale:
      return tr("link or camera is overloaded · do not steer by it");
    case CameraState::DecodeFailed:
      return tr("check versions of both ends; other views may be live");
    default:
      return {};
  }
}

}  // namespace kiln::gui
