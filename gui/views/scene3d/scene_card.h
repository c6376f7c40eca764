#pragma once

#include <QFrame>
#include <optional>
#include <vector>

#include "common/model/scene.h"

namespace kiln::gui {

/// A card over the scene that a mission's panel brings: it tells of something in the scene and
/// collects what the operator wants done to it.
class SceneCard : public QFrame {
  Q_OBJECT
 public:
  using QFrame::QFrame;
  [[nodiscard]] virtual QString keyText() const = 0;  ///< of the key in the tile's header
  [[nodiscard]] virtual QString keyTip() const = 0;
  /// Opened by the operator, or closed.
  virtual void toggle() = 0;
  /// Opens on what the operator clicked in the scene. @return false: not a thing of this card.
  virtual bool open(const SceneItem& /*item*/) { return false; }
  /// Forgets what is not sent yet (Escape).
  virtual void cancel() = 0;
  /// What the operator is about to do, in map.
  [[nodiscard]] virtual std::vector<SceneItem> ghosts() const = 0;
  /// What it is about: to be in the picture while the card is open. nullopt: nothing, or closed.
  [[nodiscard]] virtual std::optional<Eigen::Vector2d> subject() const = 0;

 signals:
  void resized();
  void refreshed();  ///< what it shows, or whether it shows
};

}  // namespace kiln::gui
