#pragma once

#include <QImage>
#include <QString>

#include "common/core/stamp.h"
#include "common/model/sensor.h"

namespace kiln::gui {

/// What is the matter with a video stream. Each has its own words, for each has its own remedy.
enum class CameraState {
  NoPicture,  ///< nothing ever came
  Live,
  Late,          ///< a picture older than 0.3 s: badge
  Stalled,       ///< pictures stopped coming (camera, cable, link)
  Stale,         ///< pictures come, but show the past (overloaded link or encoder, frozen camera)
  DecodeFailed,  ///< pictures come, but cannot be decoded
};

/// Judges one video stream. No widgets; confined to the GUI thread.
class CameraFeed {
 public:
  struct Config {
    double late_s = 0.3;
    double frozen_s = 2.0;    ///< from here on the picture is crossed out
    double arriving_s = 1.0;  ///< a stream with a message younger than this is still coming
  };
  explicit CameraFeed(Config config) : config_(config) {}
  CameraFeed() : CameraFeed(Config{}) {}
  /// A decoded picture came in. One whose pixels do not fit its size counts as not decodable, and
  /// the last good one stays on the screen.
  /// @param now  station time.
  void accept(const RgbImagePtr& image, Stamp now);
  /// @param age_s  how old the newest good picture is (arrival or capture, whichever is worse); <
  /// 0: none yet.
  void judge(Stamp now, double age_s);

  /// Of a recording: an old picture then says nothing of camera or link.
  void setRecorded(bool recorded) { recorded_ = recorded; }
  [[nodiscard]] CameraState state() const { return state_; }
  /// Nothing may be steered by it.
  [[nodiscard]] bool crossedOut() const;
  /// "frozen 2.4 s ago: no new frames"; empty while live.
  [[nodiscard]] QString headline() const;
  [[nodiscard]] QString advice() const;
  /// The newest good picture; null before the first. Shares the pixels of the message.
  [[nodiscard]] const QImage& picture() const { return picture_; }

 private:
  Config config_;
  RgbImagePtr keep_alive_;
  QImage picture_;
  CameraState state_ = CameraState::NoPicture;
  bool any_ = false, broken_ = false, recorded_ = false;
  Stamp last_message_;
  double age_s_ = -1.0;
};

}  // namespace kiln::gui
